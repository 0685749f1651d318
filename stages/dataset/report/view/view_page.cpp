#include "stages/dataset/report/view/view_page.h"

#include <fmt/core.h>

#include "common/format/html_text.h"
#include "report_view_js.h"
#include "stages/dataset/report/html.h"
#include "stages/dataset/report/page_parts.h"
#include "stages/dataset/report/view/view_data.h"

namespace tacipc {
namespace {

constexpr const char* kStyle = R"css(
html, body { height: 100%; }
body { display: flex; flex-direction: column; gap: .6rem; padding: 1rem 1.2rem; max-width: none; }
header.top { display: flex; flex-wrap: wrap; align-items: baseline; gap: .2rem 1.2rem; }
header.top h1 { margin: 0; font-size: 1.3rem; }
#stage { flex: 1; display: flex; flex-direction: column; gap: .6rem; min-height: 0; }
#stage[hidden], #bar[hidden], #states[hidden] { display: none; }
.row { flex: 1; display: flex; gap: .6rem; min-height: 0; }
.scene {
  position: relative; flex: 1; min-height: 16rem; border: 1px solid var(--line); border-radius: 12px; overflow: hidden;
  background: radial-gradient(120% 100% at 50% 0%, #fdfdfe, #d5dbe3);
}
#scene { position: absolute; inset: 0; width: 100%; height: 100%; touch-action: none; cursor: grab; }
#scene:active { cursor: grabbing; }
.scale {
  position: absolute; right: .9rem; top: .9rem; padding: .5rem .8rem; border-radius: 10px; pointer-events: none;
  background: #ffffff; color: #1b2330; font-size: .85rem; font-variant-numeric: tabular-nums;
}
#ramp { width: 15rem; max-width: 50vw; height: .8rem; margin: .25rem 0 .1rem; border-radius: 3px; }
.ticks { display: flex; justify-content: space-between; }
#states span::before { content: ""; display: inline-block; width: .8em; height: .8em; margin: 0 .4em 0 .9em; border-radius: 50%; background: var(--of); }
#states span:first-child::before { margin-left: 0; }
#images { display: flex; flex-direction: column; gap: .6rem; width: clamp(9rem, 24vw, 22rem); overflow: auto; }
#images[hidden], #of-gels[hidden], #of-robots[hidden] { display: none; }
#images img { min-height: 4rem; background: var(--card); }
@media (max-width: 700px) {
  .row { flex-direction: column; }
  #images { flex-direction: row; width: auto; }
  #images figure { flex: 1; }
}
.controls { display: flex; flex-wrap: wrap; align-items: center; gap: .5rem 1.3rem; }
.controls label { display: inline-flex; align-items: center; gap: .45rem; }
.controls select, .controls button { font: inherit; padding: .2rem .6rem; color: var(--ink); background: var(--card); border: 1px solid var(--line); border-radius: 7px; }
.controls .frames { flex: 1 1 20rem; }
.controls .frames input { flex: 1; min-width: 6rem; accent-color: var(--accent); }
#play { min-width: 5rem; }
#facts { margin: 0; max-width: none; font-variant-numeric: tabular-nums; }
.hint { max-width: none; margin: 0; }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }
)css";

constexpr const char* kStage =
    R"html(<noscript><p class="note warn">This page needs JavaScript. The pictures are in <a href="index.html">the report</a>.</p></noscript>
<div id="failure" hidden><p class="note warn"><span id="why"></span> The pictures are in <a id="pictures" href="index.html">the report</a>.</p></div>
<main id="stage">
<div class="row">
<div class="scene"><canvas id="scene" tabindex="0" role="img" aria-label="Gels and objects in 3-D; arrow keys turn, plus and minus zoom"></canvas>
<div class="scale"><div id="bar"><span id="unit"></span><div id="ramp"></div><div class="ticks"><span id="low"></span><span id="middle"></span><span id="high"></span></div></div>
<div id="states" hidden><span style="--of: #409e6b">sticks</span><span style="--of: #eb8029">slips</span><span style="--of: #c7ccd6">no contact</span></div></div></div>
<div id="images" hidden></div>
</div>
<p id="facts" aria-live="polite"></p>
<div class="controls">
<label class="frames"><button id="play" type="button">Play</button><input id="frame" type="range" min="0" max="0" step="1" value="0" aria-label="Frame"></label>
<label id="of-gels" hidden>Show <select id="seen"><option value="">all, in the world</option></select></label>
<label>Colour <select id="color"><option value="indentation">indentation</option><option value="pressure">contact pressure</option><option value="state">slip</option></select></label>
<label>Object <select id="object"><option value="glass">translucent</option><option value="solid">solid</option><option value="hidden">hidden</option></select></label>
<label id="of-robots" hidden>Robot <select id="robot"><option value="solid">solid</option><option value="glass">translucent</option><option value="hidden">hidden</option></select></label>
<label><input id="lines" type="checkbox" checked> lines 1 mm apart at rest</label>
<button id="reset" type="button">Reset view</button>
</div>
<p class="quiet hint">Drag to turn, wheel or two fingers to zoom, Shift and drag to move. Shown as saved: true to scale, no frame made up between two.</p>
</main>
)html";

}  // namespace

std::string view_data_name(const std::string& id) { return "view/" + id + ".js"; }

std::string view_link(const std::string& place) {
  return fmt::format("<a href=\"{}#{}\">Turn it in 3-D</a>", kViewPage, place);
}

std::vector<std::string> frame_texts(const SampleReport& sample, const SceneView& view) {
  std::vector<std::string> texts;
  for (std::size_t f = 0; f < view.frames.size(); ++f) {
    const auto number = static_cast<std::size_t>(view.frames[f]);
    std::string text = fmt::format("frame {} of {}", number, sample.frames.size() - 1);
    if (number < sample.frames.size()) {
      const FrameReport& frame = sample.frames[number];
      if (!frame.phase.empty()) text += " · " + frame.phase;
      if (frame.time_s) text += " · " + number_text(frame.time_s) + " s";
      text += " · press force " + number_text(frame.press_force_n) + " N";
      if (frame.tangential_force_n) text += " · tangential " + number_text(frame.tangential_force_n) + " N";
    }
    texts.push_back(text + " · deepest indentation " + number_text(deepest_indentation(view, f), 1e3) + " mm");
  }
  return texts;
}

std::string view_page(const std::string& title, const std::vector<ViewedSample>& samples) {
  std::string html =
      page_head(title + " in 3-D", "<link rel=\"icon\" href=\"data:,\">\n<style>" + page_style() + kStyle + "</style>");
  html += "<body>\n<header class=\"top\"><h1>" + html_text(title) + "</h1>\n<span class=\"controls\"><label>Sample ";
  html += "<select id=\"sample\">";
  for (const ViewedSample& sample : samples)
    html += fmt::format("<option value=\"{}\">{}</option>", sample.id, html_text(sample.name));
  html += "</select></label> <a id=\"back\" href=\"index.html\">Report</a></span></header>\n";
  return html + kStage + "<script src=\"" + kViewScript + "\"></script>\n</body>\n</html>\n";
}

std::string view_program() { return kViewProgram; }

}  // namespace tacipc
