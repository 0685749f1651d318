#include "stages/report/page.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/picture.h"
#include "stages/report/card.h"
#include "stages/report/html.h"
#include "stages/report/page_style.h"

namespace tacipc {
namespace {

/// The colours of the indentation picture as a style of their own.
std::string color_bar_style() {
  constexpr int kStops = 17;
  std::string stops;
  for (int i = 0; i < kStops; ++i) {
    const double t = static_cast<double>(i) / (kStops - 1);
    const auto [r, g, b] = perceptual_color(t);
    stops += fmt::format(", rgb({} {} {}) {:g}%", r, g, b, 100.0 * t);
  }
  return ".bar i { background: linear-gradient(90deg" + stops + "); }\n";
}

std::string tile(const std::string& number, const std::string& words, const std::string& kind = "") {
  return fmt::format("<li class=\"{}\"><b>{}</b>{}</li>\n", kind, number, words);
}

std::string tiles(const std::vector<SampleReport>& samples) {
  int passed = 0, iterations = 0;
  std::optional<double> distance_m, ratio, balance;
  const auto least = [](std::optional<double>& so_far, std::optional<double> value) {
    if (value) so_far = std::min(so_far.value_or(*value), *value);
  };
  for (const SampleReport& sample : samples) {
    passed += sample.passed() ? 1 : 0;
    iterations += sample.newton_iterations.value_or(0);
    least(distance_m, sample.min_distance_m);
    least(ratio, sample.min_volume_ratio);
    for (const FrameReport& frame : sample.frames) balance = std::max(balance, frame.balance_relative);
  }
  const int all = static_cast<int>(samples.size());
  return "<ul class=\"tiles\">\n" + tile(count_text(all), all == 1 ? "sample" : "samples") +
         tile(count_text(passed), "passed", passed > 0 ? "good" : "") +
         tile(count_text(all - passed), "failed", passed < all ? "bad" : "") +
         tile(count_text(iterations), "Newton iterations") +
         tile(number_text(distance_m, 1e6) + " µm", "smallest gel–object distance") +
         tile(number_text(ratio), "smallest volume ratio") +
         (balance ? tile(number_text(balance, 100) + " %", "largest force imbalance") : "") + "</ul>\n";
}

std::string summary_row(const SampleReport& sample, std::size_t index) {
  const DecimateReport mesh = sample.decimate.value_or(DecimateReport{});
  const std::string vertices =
      sample.decimate ? count_text(mesh.vertices_in) + " → " + count_text(mesh.vertices_out) : "–";
  const char* reference = !sample.synthetic_reference ? "–" : *sample.synthetic_reference ? "synthetic" : "real";
  std::string row = fmt::format(
      "<tr><td class=\"word\"><a href=\"#{}\">{}</a></td><td class=\"word\">{}</td><td class=\"word\">{}</td>",
      card_id(index), html_text(sample.name), sample.object.empty() ? "–" : html_text(sample.object),
      verdict_badge(sample));
  for (const std::string& cell : {number_text(sample.depth_m, 1e3), number_text(sample.press_force_n),
                                  number_text(sample.tangential_force_n), count_text(sample.newton_iterations),
                                  number_text(sample.min_distance_m, 1e6), number_text(sample.min_volume_ratio),
                                  count_text(sample.gel_vertices), vertices, number_text(mesh.hausdorff_mm)})
    row += "<td>" + cell + "</td>";
  return row + fmt::format("<td class=\"word\">{}</td></tr>\n", reference);
}

std::string summary_table(const std::vector<SampleReport>& samples) {
  std::string table =
      "<div class=\"scroll\"><table>\n<thead><tr><th class=\"word\">sample</th><th class=\"word\">object</th>"
      "<th class=\"word\">verdict</th><th>depth<br>mm</th><th>press force<br>N</th><th>tangential<br>force "
      "N</th><th>Newton<br>iterations</th>"
      "<th>smallest<br>distance µm</th><th>smallest<br>volume ratio</th><th>gel<br>vertices</th>"
      "<th>object vertices<br>in → out</th><th>Hausdorff<br>mm</th><th class=\"word\">reference<br>image</th></tr>"
      "</thead>\n<tbody>\n";
  for (std::size_t i = 0; i < samples.size(); ++i) table += summary_row(samples[i], i);
  return table + "</tbody></table></div>\n";
}

constexpr const char* kLegend = R"html(<section id="legend">
<h2>How to read this page</h2>
<dl>
<dt>Tactile image</dt><dd>What the sensor's camera sees from behind: the gel's reflecting front face, lit by coloured LEDs, deformed by the object. Colour tells which way the face leans. Image right is x, image down is y.</dd>
<dt>Indentation</dt><dd>How far the material seen in each pixel has moved into the gel.</dd>
<dt>Normals</dt><dd>The direction of the front face as a colour: (n + 1) / 2 per component, x red, y green, z blue.</dd>
<dt>Press curve</dt><dd>Force of the object on the gel, into the gel, over the depth of the object's lowest point below the undeformed face; one mark per frame. Depth below zero: the object is still above the gel.</dd>
<dt>Forces</dt><dd>On the gel by the object: press force into the gel, tangential force along the face. In the table of all samples they are those of the last frame, the depth is that at the end of the press.</dd>
<dt>Contact</dt><dd>Area of the front face that feels the object, and press force over that area.</dd>
<dt>Force balance</dt><dd>Contact force, inertia and the force of the mount that holds the gel's back must cancel; what is left over, as a part of the contact force. Each card tells how much may be left.</dd>
<dt>Markers</dt><dd>Points printed on the front face, and how far they moved along it, enlarged as the arrow beside says. Underneath the contacts, those that stick and those that slip.</dd>
<dt>Verdict</dt><dd>A sample has passed if every check of its press is within its limit in every frame and if its images exist.</dd>
<dt>Smallest distance</dt><dd>Between gel and object over all frames. It stays above zero: a barrier keeps the surfaces a small distance apart, so they never cross.</dd>
<dt>Smallest volume ratio</dt><dd>Volume of the most compressed tetrahedron of the gel, over its volume at rest. Zero would be inversion.</dd>
<dt>Hausdorff</dt><dd>Largest distance between the surface of the scan and the simplified surface that is simulated.</dd>
<dt>Reference image</dt><dd>The photograph without contact that gives the image its noise: real, or synthetic where the sensor file names none.</dd>
</dl>
</section>
)html";

}  // namespace

std::string report_page(const std::string& title, const std::vector<SampleReport>& samples,
                        const std::filesystem::path& folder) {
  std::string page =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += "<title>" + html_text(title) + "</title>\n<style>" + kPageStyle + color_bar_style() + "</style>\n</head>\n";
  page += "<body>\n<header>\n<h1>" + html_text(title) + "</h1>\n";
  page +=
      "<p class=\"quiet\">Simulated touch: each sample presses one object into the soft gel of a camera-based tactile "
      "sensor. The gel deforms by finite elements without ever intersecting the object; its images are ray traced. "
      "See all at a glance on the <a href=\"contact_sheet.png\">contact sheet</a>.</p>\n";
  page += tiles(samples) + "</header>\n";
  page += "<section id=\"summary\">\n<h2>Summary</h2>\n" + summary_table(samples) + "</section>\n";
  page += "<section id=\"samples\">\n<h2>Samples</h2>\n";
  for (std::size_t i = 0; i < samples.size(); ++i) page += sample_card(samples[i], i, folder);
  page += "</section>\n";
  page += kLegend;
  page += "<p class=\"quiet\">Record of this page: <a href=\"report.yaml\">report.yaml</a></p>\n</body>\n</html>\n";
  return page;
}

}  // namespace tacipc
