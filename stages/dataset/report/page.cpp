#include "stages/dataset/report/page.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/format/html_text.h"
#include "stages/dataset/report/card.h"
#include "stages/dataset/report/html.h"
#include "stages/dataset/report/page_parts.h"

namespace tacipc {
namespace {

std::string tiles(const std::vector<SampleReport>& samples, const std::string& thing) {
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
  return "<ul class=\"tiles\">\n" + tile(count_text(all), all == 1 ? thing : thing + "s") +
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

std::string summary_table(const std::vector<SampleReport>& samples, const std::string& thing) {
  std::string table =
      "<div class=\"scroll\"><table>\n<thead><tr><th class=\"word\">" + thing +
      "</th><th class=\"word\">object</th>"
      "<th class=\"word\">verdict</th><th>depth<br>mm</th><th>press force<br>N</th><th>tangential<br>force "
      "N</th><th>Newton<br>iterations</th>"
      "<th>smallest<br>distance µm</th><th>smallest<br>volume ratio</th><th>gel<br>vertices</th>"
      "<th>object vertices<br>in → out</th><th>Hausdorff<br>mm</th><th class=\"word\">reference<br>image</th></tr>"
      "</thead>\n<tbody>\n";
  for (std::size_t i = 0; i < samples.size(); ++i) table += summary_row(samples[i], i);
  return table + "</tbody></table></div>\n";
}

}  // namespace

std::string report_page(const std::string& title, const std::vector<SampleReport>& samples,
                        const std::filesystem::path& folder, const PageWords& words) {
  std::string page = page_head(title, "<style>" + page_style() + "</style>");
  page += "<body>\n<header>\n<h1>" + html_text(title) + "</h1>\n";
  page += "<p class=\"quiet\">" + words.intro +
          " The gel deforms by finite elements without ever intersecting the object; its images are ray traced. "
          "See all at a glance on the <a href=\"contact_sheet.png\">contact sheet</a>.</p>\n";
  page += tiles(samples, words.thing) + "</header>\n" + words.first;
  page += "<section id=\"summary\">\n<h2>Summary</h2>\n" + summary_table(samples, words.thing) + "</section>\n";
  page += "<section id=\"samples\">\n<h2>" + words.heading + "</h2>\n";
  for (std::size_t i = 0; i < samples.size(); ++i) page += sample_card(samples[i], i, folder);
  page += "</section>\n";
  page += legend();
  page += "<p class=\"quiet\">Record of this page: <a href=\"report.yaml\">report.yaml</a></p>\n</body>\n</html>\n";
  return page;
}

}  // namespace tacipc
