#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/verification/marker_curve.h"
#include "tests/verification/plot.h"

namespace tacipc::verify {
namespace {

constexpr double kMillimetre = 1e-3, kMicrometre = 1e-6;

double shown_way(const SlidingRun& run, double way) {
  return run.turns ? way * 180.0 / std::numbers::pi : way / kMillimetre;
}
std::string way_label(const SlidingRun& run) { return run.turns ? "turn (degrees)" : "way of the object (mm)"; }
std::string way_unit(const SlidingRun& run) { return run.turns ? "°" : " mm"; }
/// N, or N mm of a torque.
double shown_load(const SlidingRun& run, double load) { return run.turns ? load / kMillimetre : load; }

}  // namespace

std::string marker_curve_svg(const SlidingRun& run, const MarkerCurve& curve) {
  Curve mean{.label = "mean displacement of the markers"}, settled{.label = "from here on settled", .dots = true};
  for (std::size_t f = 0; f < curve.mean_m.size(); ++f)
    mean.points.emplace_back(shown_way(run, run.way[f]), curve.mean_m[f] / kMicrometre);
  settled.points.push_back(mean.points[static_cast<std::size_t>(curve.settled)]);
  return to_svg(
      {.title = run.name, .x_label = way_label(run), .y_label = "displacement (um)", .curves = {mean, settled}});
}

std::string marker_difference_svg(const SlidingRun& run, const MarkerCurve& curve) {
  Curve first{.label = "first difference"}, second{.label = "second difference"},
      load{.label = "friction load, of its largest"};
  const std::vector<double>& l = curve.mean_m;
  const double largest_load = *std::max_element(run.load.begin(), run.load.end());
  for (std::size_t f = 1; f < l.size(); ++f) {
    const double x = shown_way(run, run.way[f]);
    first.points.emplace_back(x, 100.0 * (l[f] - l[f - 1]) / curve.largest_first_m);
    if (f + 1 < l.size())
      second.points.emplace_back(x, 100.0 * (l[f + 1] - 2.0 * l[f] + l[f - 1]) / curve.largest_first_m);
    load.points.emplace_back(x, 100.0 * run.load[f] / largest_load);
  }
  return to_svg({.title = run.name + ": how evenly the markers follow",
                 .x_label = way_label(run),
                 .y_label = "of the largest first difference (%)",
                 .curves = {first, second, load}});
}

std::string marker_quiver_svg(const SlidingRun& run, const MarkerCurveConfig& config) {
  constexpr double kSide = 420.0, kEdge = 30.0;
  const Eigen::Matrix2Xd& moved = run.markers.back();
  const Eigen::Vector2d low = run.rest.rowwise().minCoeff(), high = run.rest.rowwise().maxCoeff();
  const double extent = std::max(1e-12, (high - low).maxCoeff());
  const double largest = std::max(1e-12, moved.colwise().norm().maxCoeff());
  // Arrows are enlarged so that the longest is as long as the grid is wide over its markers in a row, doubled.
  const double spacing = extent / std::max(1.0, std::sqrt(static_cast<double>(run.rest.cols())) - 1.0);
  const double scale = 2.0 * spacing / largest;
  const auto px = [&](double v, double from) { return kEdge + (v - from) / extent * (kSide - 2.0 * kEdge); };
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" "
      "font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"white\"/>\n"
      "<defs><marker id=\"head\" markerWidth=\"5\" markerHeight=\"4\" refX=\"4\" refY=\"2\" orient=\"auto\">"
      "<path d=\"M0 0L5 2L0 4Z\" fill=\"context-stroke\"/></marker></defs>\n",
      kSide, kSide + 40.0);
  for (Eigen::Index m = 0; m < moved.cols(); ++m) {
    const Eigen::Vector2d from = run.rest.col(m), to = from + scale * moved.col(m);
    const auto i = static_cast<std::size_t>(m);
    const bool chosen = run.rows[i] >= config.first_row && run.rows[i] <= config.last_row &&
                        run.columns[i] >= config.first_column && run.columns[i] <= config.last_column;
    out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.2\" fill=\"#888\"/>", px(from.x(), low.x()),
                       px(from.y(), low.y()));
    if (moved.col(m).norm() > 0.01 * largest)
      out += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\" marker-end=\"url(#head)\"/>",
                         px(from.x(), low.x()), px(from.y(), low.y()), px(to.x(), low.x()), px(to.y(), low.y()),
                         chosen ? "#c2571a" : "#1f5fa8");
    out += '\n';
  }
  out += fmt::format(
      "<text x=\"{0:.1f}\" y=\"{1:.1f}\" text-anchor=\"middle\">{2}: longest {3:.0f} um, drawn {4:.1f} times as long"
      "<tspan x=\"{0:.1f}\" dy=\"14\">orange: the markers that are judged</tspan></text>\n</svg>\n",
      kSide / 2, kSide + 12.0, run.name, largest / kMicrometre, scale);
  return out;
}

std::string marker_curve_csv(const SlidingRun& run, const MarkerCurve& curve) {
  std::string out = fmt::format("frame,{},mean_displacement_um,press_force_n,{},sticking_share\n",
                                run.turns ? "turn_deg" : "way_mm", run.turns ? "torque_n_mm" : "tangential_force_n");
  for (std::size_t f = 0; f < curve.mean_m.size(); ++f)
    out += fmt::format("{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", run.press_end_frame + static_cast<int>(f),
                       shown_way(run, run.way[f]), curve.mean_m[f] / kMicrometre, run.press_force_n[f],
                       shown_load(run, run.load[f]), run.sticking[f]);
  return out;
}

std::string marker_curve_found(const std::vector<SlidingRun>& runs, const std::vector<MarkerCurve>& curves,
                               const MarkerCurveConfig& config) {
  std::string out = "second differences of the markers' way once settled:";
  for (std::size_t i = 0; i < runs.size(); ++i)
    out += fmt::format("{} {} {:.2f} % ({} gel vertices)", i ? "," : "", runs[i].name, 100.0 * curves[i].ratio(),
                       runs[i].gel_vertices);
  return out + fmt::format("; limit {:g} % of the largest first difference", 100.0 * config.second_difference_limit);
}

std::string marker_curve_page(const std::vector<SlidingRun>& runs, const std::vector<MarkerCurve>& curves,
                              const MarkerCurveConfig& config) {
  std::string out = fmt::format(
      "# Markers under a dragged or turned object\n\nWritten by `make -f Makefile.data board3`; what it shows: "
      "[board3](../board3.md). Markers of rows {} to {} and columns {} to {}, "
      "mean length of their displacement in x and y since the end of the press. "
      "Settled: the friction load stays above {:g} % of its largest.\n\n"
      "| Sample | Gel vertices | Frames after the press | Largest first difference | Settled from | Largest second "
      "difference from there | Limit | | Over the whole motion |\n|---|---|---|---|---|---|---|---|---|\n",
      config.first_row, config.last_row, config.first_column, config.last_column, 100.0 * config.settled_load);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const SlidingRun& run = runs[i];
    const MarkerCurve& c = curves[i];
    out += fmt::format("| {} | {} | {} | {:.3f} µm | {:.3g}{} | {:.4f} µm = {:.2f} % | {:g} % | {} | {:.2f} % |\n",
                       run.name, run.gel_vertices, c.mean_m.size() - 1, c.largest_first_m / kMicrometre,
                       shown_way(run, run.way[static_cast<std::size_t>(c.settled)]), way_unit(run),
                       c.largest_second_m / kMicrometre, 100.0 * c.ratio(), 100.0 * config.second_difference_limit,
                       c.ratio() < config.second_difference_limit ? "holds" : "**missed**",
                       100.0 * c.largest_second_ever_m / c.largest_first_m);
  }
  out +=
      "\n| Sample | Verdict | Markers at the end | Press force | Friction load: largest, at the end | All slip from | "
      "Balance | "
      "Smallest gap | Smallest volume ratio |\n|---|---|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const SlidingRun& run = runs[i];
    const auto [low, high] = std::minmax_element(run.press_force_n.begin(), run.press_force_n.end());
    const char* unit = run.turns ? "N mm" : "N";
    out += fmt::format(
        "| {} | {} | {:.1f} µm | {:.4f} … {:.4f} N | {:.4g}, {:.4g} {} | {} | {:.1e} | {:.1f} µm | {:.2f} |\n",
        run.name, run.verdict, curves[i].mean_m.back() / kMicrometre, *low, *high,
        shown_load(run, *std::max_element(run.load.begin(), run.load.end())), shown_load(run, run.load.back()), unit,
        run.gross_slip_way ? fmt::format("{:.3g}{}", shown_way(run, *run.gross_slip_way), way_unit(run)) : "never",
        run.max_balance_relative, run.min_distance_m / kMicrometre, run.min_volume_ratio);
  }
  out += '\n';
  for (const SlidingRun& run : runs)
    for (const char* picture : {"curve", "differences", "quiver"})
      out += fmt::format("![{0}: {1}]({0}_{1}.svg)\n", run.name, picture);
  return out;
}

}  // namespace tacipc::verify
