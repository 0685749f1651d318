// How the page looks. One sheet, inside the page, so that the page is one file; light or dark as the reader's system
// is.
#pragma once

namespace tacipc {

inline constexpr const char* kPageStyle = R"css(
:root {
  color-scheme: light dark;
  --paper: #f5f6f8; --card: #ffffff; --ink: #1b2330; --quiet: #5d6878; --line: #dde2e9; --accent: #1f6f8b;
  --good: #15703c; --good-paper: #dcf3e4; --bad: #a3231b; --bad-paper: #fde4e1; --warn: #6f5200; --warn-paper: #fdf3d3;
  --color-2: #c2571a; --color-3: #7a4fb5; --color-4: #2f7d4f; --stuck: #8fc7a4; --slipping: #f0a35e;
}
@media (prefers-color-scheme: dark) {
  :root {
    --paper: #12161c; --card: #1b2129; --ink: #e6eaf0; --quiet: #9aa6b6; --line: #313a46; --accent: #6cc3de;
    --good: #7ddba0; --good-paper: #16361f; --bad: #ff9d94; --bad-paper: #451b18; --warn: #f0d27a; --warn-paper: #382d0d;
    --color-2: #f2955a; --color-3: #b99be6; --color-4: #7cc79a; --stuck: #2f6b47; --slipping: #a5622a;
  }
}
* { box-sizing: border-box; }
body {
  margin: 0 auto; padding: 2rem 1.5rem 3rem; max-width: 1560px; background: var(--paper); color: var(--ink);
  font: 15px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", sans-serif;
}
h1 { margin: 0 0 .3rem; font-size: 2rem; line-height: 1.2; letter-spacing: -.01em; overflow-wrap: anywhere; }
h2 { margin: 2.6rem 0 .8rem; font-size: 1.3rem; }
h3 { margin: 0; font-size: 1.2rem; overflow-wrap: anywhere; }
h4 { margin: 0 0 .4rem; font-size: .82rem; text-transform: uppercase; letter-spacing: .06em; color: var(--quiet); }
p { margin: .4rem 0; max-width: 80ch; }
a { color: var(--accent); text-decoration: none; }
a:hover { text-decoration: underline; }
.quiet { color: var(--quiet); }
.tiles { display: flex; flex-wrap: wrap; gap: .8rem; margin: 1.2rem 0 0; padding: 0; list-style: none; }
.tiles li {
  min-width: 8.5rem; padding: .7rem 1.1rem; border: 1px solid var(--line); border-radius: 10px;
  background: var(--card); color: var(--quiet);
}
.tiles b { display: block; color: var(--ink); font-size: 1.5rem; line-height: 1.3; font-variant-numeric: tabular-nums; }
.tiles .good b { color: var(--good); }
.tiles .bad b { color: var(--bad); }
.scroll { overflow-x: auto; border: 1px solid var(--line); border-radius: 10px; background: var(--card); }
table { width: 100%; border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { padding: .45rem .7rem; text-align: right; white-space: nowrap; border-top: 1px solid var(--line); }
thead th { border-top: 0; color: var(--quiet); font-weight: 600; vertical-align: bottom; line-height: 1.3; }
th.word, td.word { text-align: left; }
tbody tr:hover { background: color-mix(in srgb, var(--accent) 7%, transparent); }
.verdict { display: inline-block; padding: .05rem .6rem; border-radius: 99px; font-weight: 600; font-size: .85rem; }
.passed { color: var(--good); background: var(--good-paper); }
.failed { color: var(--bad); background: var(--bad-paper); }
.card {
  margin: 0 0 1.4rem; padding: 1.2rem 1.3rem; border: 1px solid var(--line); border-radius: 12px;
  background: var(--card); scroll-margin-top: 1rem;
}
.card > header { display: flex; flex-wrap: wrap; align-items: center; gap: .3rem .8rem; margin-bottom: .9rem; }
.note { margin: 0 0 .8rem; padding: .5rem .8rem; max-width: none; border-radius: 8px; overflow-wrap: anywhere; }
.note.bad { color: var(--bad); background: var(--bad-paper); }
.note.warn { color: var(--warn); background: var(--warn-paper); }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(300px, 100%), 1fr)); gap: 1rem; }
.pictures + .pictures { margin-top: 1rem; }
figure { margin: 0; min-width: 0; }
figure > a { display: block; }
figure img { display: block; width: 100%; height: auto; border-radius: 6px; }
.strip { overflow-x: auto; margin: .8rem 0 1rem; }
.strip img { min-width: 48rem; }
figcaption { margin-top: .35rem; font-size: .85rem; color: var(--quiet); }
figcaption b { color: var(--ink); }
.bar { display: flex; align-items: center; gap: .5rem; margin-top: .25rem; font-variant-numeric: tabular-nums; }
.bar i { flex: 1; height: .8rem; border-radius: 3px; }
.bar i, .swatch { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
.swatches { display: flex; flex-wrap: wrap; gap: .1rem .8rem; margin-top: .25rem; }
.swatch { display: inline-block; width: .8rem; height: .8rem; margin-right: .3rem; border-radius: 3px; vertical-align: -1px; }
.facts { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(300px, 100%), 1fr)); gap: 1rem 1.6rem; margin: 1.1rem 0 .8rem; }
dl { display: grid; grid-template-columns: auto 1fr; gap: .1rem .9rem; margin: 0; font-size: .9rem; }
dt { color: var(--quiet); }
dd { margin: 0; overflow-wrap: anywhere; font-variant-numeric: tabular-nums; }
#legend dl { padding: 1rem 1.3rem; border: 1px solid var(--line); border-radius: 12px; background: var(--card); }
#legend dt { color: var(--ink); font-weight: 600; }
#legend dd { max-width: 90ch; }
details { margin-top: .5rem; font-size: .9rem; }
summary { cursor: pointer; color: var(--accent); }
details .scroll { margin-top: .5rem; }
.files { margin: .3rem 0 0; font-size: .9rem; max-width: none; }
.checks { grid-column: 1 / -1; overflow-x: auto; }
.checks table { width: auto; }
.checks td { padding: .15rem 1.2rem .15rem 0; border: 0; }
.mark { display: inline-block; width: 1.3rem; font-weight: 600; }
.held { color: var(--good); }
.missed { color: var(--bad); }
.curve, .quiver { display: block; width: 100%; height: auto; }
.curve text, .quiver text { fill: var(--quiet); font-size: 13px; font-variant-numeric: tabular-nums; }
.curve .grid { stroke: var(--line); stroke-width: 1; }
.curve .axis { fill: none; stroke: var(--quiet); stroke-width: 1.2; }
.curve .band { fill: var(--ink); fill-opacity: .02; }
.curve .dark { fill-opacity: .07; }
.curve .rule { fill: none; stroke: var(--bad); stroke-width: 1.2; stroke-dasharray: 5 4; }
.curve .band-name { font-size: 11px; }
.curve .rule-name { font-size: 11px; fill: var(--bad); }
.curve polyline { fill: none; stroke: currentColor; stroke-width: 2; stroke-linejoin: round; }
.curve .broad polyline { stroke-width: 8; stroke-opacity: .3; }
.curve circle { fill: var(--card); stroke: currentColor; stroke-width: 2; }
.color-1 { color: var(--accent); }
.color-2 { color: var(--color-2); }
.color-3 { color: var(--color-3); }
.color-4 { color: var(--color-4); }
.key { display: inline-block; width: 1.2rem; margin-right: .3rem; border-top: 3px solid currentColor; vertical-align: middle; }
.key.broad { border-top-width: 9px; opacity: .35; }
.quiver path { fill: none; stroke-linecap: round; stroke-linejoin: round; }
.quiver .face { fill: var(--paper); stroke: var(--line); }
.quiver .stuck { stroke: var(--stuck); stroke-width: 4; }
.quiver .slipping { stroke: var(--slipping); stroke-width: 4; }
.quiver .dots { stroke: var(--quiet); stroke-width: 2; }
.quiver .arrows { stroke: var(--ink); stroke-width: 1.3; }
.dot { display: inline-block; width: .7rem; height: .7rem; margin-right: .3rem; border-radius: 50%; }
.dot.stuck { background: var(--stuck); }
.dot.slipping { background: var(--slipping); }
.key, .dot { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
@media (max-width: 600px) {
  body { padding: 1.2rem .8rem 2rem; }
  #legend dl { grid-template-columns: 1fr; }
  #legend dd { margin-bottom: .5rem; }
}
@media print {
  body { max-width: none; padding: 0; background: none; }
  .card { break-inside: avoid; }
}
)css";

}  // namespace tacipc
