// What the pages of a dataset add to the look of a page of samples.
#pragma once

namespace tacipc {

inline constexpr const char* kSiteStyle = R"css(
html { scroll-padding-top: 1rem; }
a:focus-visible, summary:focus-visible, .scroll:focus-visible {
  outline: 3px solid var(--accent); outline-offset: 2px; border-radius: 4px;
}
main:focus { outline: none; }
main > .card { margin-top: .8rem; }
.skip { position: absolute; left: -999px; top: .5rem; padding: .5rem 1rem; background: var(--card); border-radius: 8px; }
.skip:focus { left: .8rem; z-index: 1; }
header.site { margin-bottom: 1.6rem; padding-bottom: .7rem; border-bottom: 1px solid var(--line); }
header.site nav { display: flex; flex-wrap: wrap; gap: .3rem 1.4rem; align-items: baseline; }
header.site .home { font-weight: 700; font-size: 1.05rem; color: var(--ink); overflow-wrap: anywhere; }
footer { margin-top: 3rem; padding-top: .8rem; border-top: 1px solid var(--line); font-size: .9rem; }
.lead { font-size: 1.05rem; }
.tiles + .note { margin-top: 1rem; }
.note code { font-size: .9rem; }
.keys { display: block; margin: .15rem 0; }
.keys span { margin-right: .9rem; white-space: nowrap; }
.worst { grid-template-columns: minmax(0, auto) auto; justify-content: start; gap: .3rem 1.6rem; max-width: 40rem; }
.worst dd { overflow-wrap: normal; white-space: nowrap; }
.pager { display: flex; flex-wrap: wrap; gap: .4rem 1rem; margin: .8rem 0; align-items: baseline; overflow-wrap: anywhere; }
.pager a { min-width: 1.6rem; text-align: center; }
.plots { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(340px, 100%), 1fr)); gap: 1rem; }
.plots figure, .diagram { padding: 1rem; border: 1px solid var(--line); border-radius: 12px; background: var(--card); }
.bars rect, .cells rect { fill: currentColor; }
.spread path { stroke: var(--quiet); stroke-width: 1.2; fill: none; }
.spread rect { fill: var(--accent); fill-opacity: .55; }
.spread .median { stroke: var(--ink); stroke-width: 2.5; }
.sheet { display: grid; grid-template-columns: repeat(auto-fill, minmax(150px, 1fr)); gap: .8rem; padding: 0; margin: 1rem 0; list-style: none; }
.sheet a { display: block; padding: .4rem; border: 1px solid var(--line); border-radius: 10px; background: var(--card); color: var(--ink); font-size: .82rem; line-height: 1.35; overflow-wrap: anywhere; }
.sheet a:hover { border-color: var(--accent); text-decoration: none; }
.sheet img { display: block; width: 100%; height: auto; margin-bottom: .3rem; border-radius: 6px; }
.sheet .none { display: grid; place-items: center; aspect-ratio: 4 / 3; margin-bottom: .3rem; border-radius: 6px; background: var(--bad-paper); color: var(--bad); font-weight: 600; }
.sheet .gone { background: var(--line); color: var(--quiet); }
.tables { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(480px, 100%), 1fr)); gap: 1rem; align-items: start; }
.tables h3, .facts-list h3, h3.over { margin: 0 0 .5rem; font-size: 1rem; }
h3.over { margin-top: 1.4rem; }
.tables th, .tables td { padding: .35rem .55rem; }
.tall { max-height: 30rem; overflow-y: auto; }
td.wrap { text-align: left; white-space: normal; min-width: 18rem; overflow-wrap: anywhere; }
.share { display: flex; width: 4rem; height: .7rem; border-radius: 3px; overflow: hidden; background: var(--line); }
.share i { display: block; height: 100%; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
.share .made { background: var(--good); }
.share .failed { background: var(--bad); }
.share .running { background: var(--color-2); }
.status-failed { color: var(--bad); font-weight: 600; }
.status-running { color: var(--warn); font-weight: 600; }
.status-unmade { color: var(--quiet); }
.prose { max-width: 80ch; }
.prose li { margin: .25rem 0; }
.diagram { max-width: 40rem; margin: 1rem 0; }
.diagram svg { display: block; width: 100%; height: auto; }
.diagram text { fill: var(--ink); font-size: 13px; }
.diagram .soft { fill: var(--quiet); }
.diagram .gel { fill: var(--stuck); fill-opacity: .55; stroke: var(--good); }
.diagram .body { fill: var(--line); stroke: var(--quiet); }
.diagram .arrow { fill: none; stroke: var(--accent); stroke-width: 2.2; }
.diagram .ray { fill: none; stroke: var(--quiet); stroke-dasharray: 4 4; }
@media (max-width: 600px) {
  .sheet { grid-template-columns: repeat(2, 1fr); }
  .tiles { display: grid; grid-template-columns: 1fr 1fr; gap: .6rem; }
  .tiles li { min-width: 0; padding: .6rem .8rem; }
  .tiles b { font-size: 1.25rem; }
  td.wrap { min-width: 14rem; }
}
)css";

}  // namespace tacipc
