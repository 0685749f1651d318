#include <fmt/core.h>

#include "common/image/svg.h"
#include "stages/image/depthnet/outcome_report.h"
#include "stages/image/depthnet/scores.h"

namespace tacipc {
namespace {

constexpr PlotArea kArea{.left = 50.0, .right = 350.0, .top = 14.0, .bottom = 314.0};
constexpr double kWidth = 366.0, kHeight = 412.0, kLegend = 366.0, kLine = 16.0;
constexpr const char *kNetwork = "#1f5fa8", *kShuffled = "#c2571a", *kGrip = "#3a8a4a";
constexpr int kShares = 100;  // positions on the x axis at which curves are averaged

using Roc = std::vector<std::pair<double, double>>;

double x_at(double share) { return kArea.left + share * (kArea.right - kArea.left); }
double y_at(double share) { return kArea.bottom - share * (kArea.bottom - kArea.top); }

std::string curve(const Roc& points, const char* color, const char* look) {
  std::string path;
  for (const auto& [x, y] : points) path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x_at(x), y_at(y));
  return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" {}/>\n", path, color, look);
}

/// Curves of all seeds, pale, and their mean.
std::string curves_of(const OutcomeStudy& study, bool shuffled, const char* color) {
  const std::vector<bool> held = held_of(study.test);
  std::string svg;
  Roc mean(kShares + 1);
  double seeds = 0.0;
  for (const OutcomeTraining& training : study.trainings) {
    if (training.shuffled != shuffled) continue;
    const Roc roc = roc_of(training.probabilities, held);
    svg += curve(roc, color, "stroke-opacity=\"0.3\"");
    for (int k = 0; k <= kShares; ++k) mean[k].second += height_of(roc, 1.0 * k / kShares);
    ++seeds;
  }
  for (int k = 0; k <= kShares; ++k) {
    auto& [x, y] = mean[k];
    x = 1.0 * k / kShares;
    y /= seeds;
  }
  return svg + curve(mean, color, "stroke-width=\"2.5\"");
}

std::string legend(int line, const char* color, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}</text>\n", kArea.left, kLegend + kLine * line,
                     color, text);
}

}  // namespace

std::string roc_svg(const OutcomeStudy& study) {
  std::vector<Tick> x, y;
  for (int k = 0; k <= 5; ++k) {
    x.push_back({x_at(0.2 * k), fmt::format("{:.1f}", 0.2 * k)});
    y.push_back({y_at(0.2 * k), fmt::format("{:.1f}", 0.2 * k)});
  }
  std::string svg =
      svg_file_start(kWidth, kHeight, 11) + x_ticks_svg(x, kArea, file_axes()) + y_ticks_svg(y, kArea, file_axes());
  svg += axes_svg(kArea, file_axes());
  svg += curve({{0.0, 0.0}, {1.0, 1.0}}, "#888", "stroke-dasharray=\"3 4\"");
  svg += curves_of(study, true, kShuffled);
  svg += curve(roc_of(study.grip_only, held_of(study.test)), kGrip, "stroke-width=\"2.5\"");
  svg += curves_of(study, false, kNetwork);
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">not held, foretold as held</text>\n",
                     0.5 * (kArea.left + kArea.right), kArea.bottom + 32.0);
  svg += fmt::format(
      "<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">held, foretold as held</text>\n",
      0.5 * (kArea.top + kArea.bottom));
  svg += legend(0, kNetwork, "network: each seed, and the mean");
  svg += legend(1, kShuffled, "outcomes shuffled in the training");
  svg += legend(2, kGrip, "force of the grip alone");
  return svg + "</svg>\n";
}

}  // namespace tacipc
