#include "bench/element_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/image/plot.h"
#include "tacipc_bench_texts.h"

namespace tacipc::bench {
namespace {

constexpr const char* kObject = "sphere";

/// Presses of the sphere by one route, coarsest mesh first.
std::vector<const Run*> presses(const std::vector<Run>& runs, const std::string& route) {
  std::vector<const Run*> found;
  for (const Run& run : runs) {
    const RunName& name = run.name;
    if (name.object == kObject && name.motion == "press" && name.route == route && name.how.empty())
      found.push_back(&run);
  }
  std::ranges::sort(found, [](const Run* a, const Run* b) { return a->gel_vertices < b->gel_vertices; });
  return found;
}

std::optional<Limit> limit_of(const std::vector<const Run*>& runs) {
  if (runs.size() < 3) return std::nullopt;
  std::vector<int> vertices;
  std::vector<double> forces;
  for (auto run = runs.end() - 3; run != runs.end(); ++run) {
    vertices.push_back((*run)->gel_vertices);
    forces.push_back((*run)->press_force_n);
  }
  return extrapolate(vertices, forces);
}

}  // namespace

std::optional<Limit> extrapolate(const std::vector<int>& vertices, const std::vector<double>& forces) {
  std::array<double, 3> h;
  for (int i = 0; i < 3; ++i) h[i] = 1.0 / std::cbrt(vertices[i]);
  const double seen = (forces[0] - forces[1]) / (forces[1] - forces[2]);
  const auto ratio = [&](double p) {
    return (std::pow(h[0], p) - std::pow(h[1], p)) / (std::pow(h[1], p) - std::pow(h[2], p));
  };
  double low = 0.2, high = 6.0;  // the ratio grows with the order
  if (!(seen > ratio(low)) || !(seen < ratio(high))) return std::nullopt;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (ratio(middle) < seen ? low : high) = middle;
  }
  const double c = (forces[1] - forces[2]) / (std::pow(h[1], low) - std::pow(h[2], low));
  return Limit{forces[2] - c * std::pow(h[2], low), low};
}

std::string element_section(const std::vector<Run>& runs) {
  const auto linear = presses(runs, "fast"), averaged = presses(runs, "averaged");
  const auto limit = limit_of(averaged), of_linear = limit_of(linear);
  if (!limit) return "";
  std::string rows;
  for (const Run* b : averaged) {
    const auto a = std::ranges::find_if(linear, [&](const Run* run) { return run->name.gel == b->name.gel; });
    const auto side = [&](const Run& run) {
      return fmt::format(" {:.4f} | {:+.1f} % | {:.1f} |", run.press_force_n,
                         100.0 * (run.press_force_n / limit->value - 1.0), run.processor_s);
    };
    rows += fmt::format("| {} |{}{}\n", b->gel_vertices, a != linear.end() ? side(**a) : " | | |", side(*b));
  }
  return fmt::format(
      kElementSection, limit->value, limit->order,
      of_linear ? fmt::format("; the linear element's three finest extrapolate to {:.4f} N", of_linear->value) : "",
      rows);
}

std::string element_svg(const std::vector<Run>& runs) {
  Plot plot{.title = "Press of a sphere: force against its limit",
            .x_label = "CPU seconds",
            .y_label = "relative error of the force",
            .logarithmic = true};
  if (const auto limit = limit_of(presses(runs, "averaged"))) {
    for (const auto& [route, label] : {std::pair("fast", "linear"), std::pair("averaged", "averaged volume")}) {
      PlotCurve& curve = plot.curves.emplace_back(PlotCurve{.label = label});
      for (const Run* run : presses(runs, route))
        curve.points.emplace_back(run->processor_s, std::abs(run->press_force_n / limit->value - 1.0));
    }
  }
  return to_svg(plot);
}

}  // namespace tacipc::bench
