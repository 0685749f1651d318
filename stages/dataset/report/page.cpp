#include "stages/dataset/report/page.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/format/html_text.h"
#include "stages/dataset/report/card.h"
#include "stages/dataset/report/html.h"
#include "tacipc_report_texts.h"

namespace tacipc {
namespace {

std::string tiles(const std::vector<SampleReport>& samples, const std::string& thing) {
  std::size_t passed = 0;
  int iterations = 0;
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
  const std::size_t all = samples.size();
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

}  // namespace

std::string report_page(const std::string& title, const std::vector<SampleReport>& samples,
                        const std::filesystem::path& folder, const PageWords& words) {
  std::string rows, cards;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    rows += summary_row(samples[i], i);
    cards += sample_card(samples[i], i, folder);
  }
  using fmt::arg;
  return page_head(title, "<style>" + page_style() + "</style>") +
         fmt::format(kPage, arg("title", html_text(title)), arg("intro", words.intro),
                     arg("tiles", tiles(samples, words.thing)), arg("first", words.first), arg("thing", words.thing),
                     arg("rows", rows), arg("heading", words.heading), arg("cards", cards), arg("legend", legend()));
}

}  // namespace tacipc
