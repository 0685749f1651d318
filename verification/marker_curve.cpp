#include "verification/marker_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/base/units.h"
#include "common/image/plot.h"
#include "common/sample/press_folder.h"
#include "common/sample/press_record.h"
#include "tacipc_verification_long_texts.h"
#include "verification/stage_record.h"

namespace tacipc::verify {
namespace {

double shown_way(const SlidingRun& run, double way) {
  return run.turns ? way * 180.0 / std::numbers::pi : way / kMillimetre;
}
std::string way_label(const SlidingRun& run) { return run.turns ? "turn (degrees)" : "travel of the object (mm)"; }
std::string way_unit(const SlidingRun& run) { return run.turns ? "°" : " mm"; }
/// Load in N, or in N mm for a torque.
double shown_load(const SlidingRun& run, double load) { return run.turns ? load / kMillimetre : load; }

/// Motions of the same kind as the run: sideways or turning.
std::vector<MarkerMotion> of_kind(const std::vector<MarkerMotion>& others, const SlidingRun& run) {
  std::vector<MarkerMotion> out;
  for (const MarkerMotion& other : others)
    if (other.turns == run.turns) out.push_back(other);
  return out;
}

}  // namespace

MarkerCurveConfig MarkerCurveConfig::read(ConfigReader& in) {
  MarkerCurveConfig config;
  config.chosen = MarkerChoice::read(in);
  config.settled_load = in.number("settled_load", Range{.low = 0.0, .high = 1.0, .open_low = true, .open_high = true});
  config.second_difference_limit = in.number("second_difference_limit", Range::positive());
  return config;
}

SlidingRun read_sliding_run(const std::filesystem::path& press) {
  if (const auto failure = why_no_record(press, "press"))
    throw DataError("{}: the press failed: {}", press.lexically_normal().parent_path().filename().string(), *failure);
  SlidingRun run;
  const Record record = Record::from_file(press / "press.yaml");
  run.name = record.required_text("name");
  const auto summary = summary_of<PressSummary>(record);
  run.verdict = summary.required(&PressSummary::verdict);
  run.gel_vertices = summary.required(&PressSummary::gel_vertices);
  run.max_balance_relative = summary.required(&PressSummary::max_balance_relative);
  run.min_distance_m = summary.required(&PressSummary::min_distance_m);
  run.min_volume_ratio = summary.required(&PressSummary::min_volume_ratio);
  const auto lines = summary.sections(&PressSummary::per_frame);
  const std::size_t frames = lines.size(),
                    end = static_cast<std::size_t>(summary.required(&PressSummary::press_end_frame));
  if (frames < end + 2) throw DataError("{}: nothing follows the press, which ends at frame {}", press.string(), end);

  const PressFolder arrays(press, {{kFrames, frames}});
  const std::vector<Wrench> wrenches = arrays.wrenches();
  const std::vector<Matrix4> poses = arrays.poses();
  static_cast<MarkerMotion&>(run) = read_marker_motion(press, run.name, frames, end);
  for (std::size_t f = end; f < frames; ++f) {
    const Vector3 &force = wrenches[f].force_n, &torque = wrenches[f].torque_n_m;
    run.press_force_n.push_back(0.0 - force.z());
    const double x = poses[f](0, 3), y = poses[f](1, 3);  // position of the object's axis
    run.load.push_back(run.turns ? std::abs(torque.z() - (x * force.y() - y * force.x()))
                                 : std::hypot(force.x(), force.y()));
    const double sticking = lines[f].number(&PressFrameLines::sticking),
                 slipping = lines[f].number(&PressFrameLines::slipping);
    run.sticking.push_back(sticking + slipping > 0.0 ? sticking / (sticking + slipping) : 0.0);
    if (f > end && !run.gross_slip_way && slipping > 0.0 && sticking == 0.0) run.gross_slip_way = run.way[f - end];
  }
  return run;
}

MarkerCurve marker_curve(const SlidingRun& run, const MarkerCurveConfig& config) {
  MarkerCurve curve;
  curve.mean_m = mean_displacements(run, config.chosen);
  const int frames = static_cast<int>(curve.mean_m.size());
  const double enough = config.settled_load * *std::ranges::max_element(run.load);
  for (int f = 0; f < frames; ++f)
    if (run.load[f] < enough) curve.settled = f + 1;
  if (frames - curve.settled < 3)
    throw DataError("{}: sliding becomes steady at frame {} of {} after the press: too late to judge", run.name,
                    curve.settled, frames - 1);
  const std::vector<double>& l = curve.mean_m;
  for (std::size_t f = 1; f < l.size(); ++f)
    curve.largest_first_m = std::max(curve.largest_first_m, std::abs(l[f] - l[f - 1]));
  for (std::size_t f = 2; f + 1 < l.size(); ++f) {
    const double second = std::abs(l[f + 1] - 2.0 * l[f] + l[f - 1]);
    curve.largest_second_ever_m = std::max(curve.largest_second_ever_m, second);
    if (static_cast<int>(f) > curve.settled) curve.largest_second_m = std::max(curve.largest_second_m, second);
  }
  return curve;
}

std::string marker_curve_svg(const SlidingRun& run, const MarkerCurve& curve, const std::vector<MarkerMotion>& others,
                             const MarkerCurveConfig& config) {
  const auto points = [&](const std::vector<double>& way, const std::vector<double>& mean_m) {
    std::vector<Eigen::Vector2d> out;
    for (std::size_t f = 0; f < mean_m.size(); ++f) out.emplace_back(shown_way(run, way[f]), mean_m[f] / kMicrometre);
    return out;
  };
  PlotCurve mean{.label = "mean displacement of the markers", .points = points(run.way, curve.mean_m)};
  PlotCurve settled{.label = "settled from here", .dots = true};
  settled.points.push_back(mean.points[curve.settled]);
  std::vector<PlotCurve> curves{mean, settled};
  for (const MarkerMotion& other : of_kind(others, run))
    curves.push_back(
        {.label = "the same by " + other.name, .points = points(other.way, mean_displacements(other, config.chosen))});
  return to_svg({.title = run.name, .x_label = way_label(run), .y_label = "displacement (um)", .curves = curves});
}

std::string marker_difference_svg(const SlidingRun& run, const MarkerCurve& curve) {
  PlotCurve first{.label = "first difference"}, second{.label = "second difference"},
      load{.label = "friction load, of its largest"};
  const std::vector<double>& l = curve.mean_m;
  const double largest_load = *std::ranges::max_element(run.load);
  for (std::size_t f = 1; f < l.size(); ++f) {
    const double x = shown_way(run, run.way[f]);
    first.points.emplace_back(x, 100.0 * (l[f] - l[f - 1]) / curve.largest_first_m);
    if (f + 1 < l.size())
      second.points.emplace_back(x, 100.0 * (l[f + 1] - 2.0 * l[f] + l[f - 1]) / curve.largest_first_m);
    load.points.emplace_back(x, 100.0 * run.load[f] / largest_load);
  }
  return to_svg({.title = run.name + ": evenness of the markers' motion",
                 .x_label = way_label(run),
                 .y_label = "of the largest first difference (%)",
                 .curves = {first, second, load}});
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
  std::string out = "second differences of the markers' displacement once settled:";
  for (std::size_t i = 0; i < runs.size(); ++i)
    out += fmt::format("{} {} {:.2f} % ({} gel vertices)", i ? "," : "", runs[i].name, 100.0 * curves[i].ratio(),
                       runs[i].gel_vertices);
  return out + fmt::format("; limit {:g} % of the largest first difference", 100.0 * config.second_difference_limit);
}

std::string marker_curve_page(const std::vector<SlidingRun>& runs, const std::vector<MarkerCurve>& curves,
                              const std::vector<MarkerMotion>& others, const MarkerCurveConfig& config) {
  std::string evenness, loads, compared, pictures;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const SlidingRun& run = runs[i];
    const MarkerCurve& c = curves[i];
    evenness += fmt::format("| {} | {} | {} | {:.3f} µm | {:.3g}{} | {:.4f} µm = {:.2f} % | {:g} % | {} | {:.2f} % |\n",
                            run.name, run.gel_vertices, c.mean_m.size() - 1, c.largest_first_m / kMicrometre,
                            shown_way(run, run.way[c.settled]), way_unit(run), c.largest_second_m / kMicrometre,
                            100.0 * c.ratio(), 100.0 * config.second_difference_limit,
                            c.ratio() < config.second_difference_limit ? "holds" : "**missed**",
                            100.0 * c.largest_second_ever_m / c.largest_first_m);
    const auto [low, high] = std::ranges::minmax_element(run.press_force_n);
    const char* unit = run.turns ? "N mm" : "N";
    loads += fmt::format(
        "| {} | {} | {:.1f} µm | {:.4f} … {:.4f} N | {:.4g}, {:.4g} {} | {} | {:.1e} | {:.1f} µm | {:.2f} |\n",
        run.name, run.verdict, c.mean_m.back() / kMicrometre, *low, *high,
        shown_load(run, *std::ranges::max_element(run.load)), shown_load(run, run.load.back()), unit,
        run.gross_slip_way ? fmt::format("{:.3g}{}", shown_way(run, *run.gross_slip_way), way_unit(run)) : "never",
        run.max_balance_relative, run.min_distance_m / kMicrometre, run.min_volume_ratio);
  }
  if (!others.empty())
    compared =
        "\nThe same markers by another simulator, at the end of the travel:\n\n| Sample | Simulator | Markers at the "
        "end | Of ours | Difference of the vectors, mean | largest |\n|---|---|---|---|---|---|\n";
  for (const SlidingRun& run : runs)
    for (const MarkerMotion& other : of_kind(others, run)) {
      const MotionComparison c = compare(run, other, config.chosen);
      compared += fmt::format("| {} | {} | {:.1f} µm | {:.3f} | {:.1f} µm | {:.1f} µm |\n", run.name, other.name,
                              c.mean_m / kMicrometre, c.ratio, c.error_m / kMicrometre, c.largest_m / kMicrometre);
    }
  for (const SlidingRun& run : runs) {
    for (const char* picture : {"curve", "differences", "quiver"})
      pictures += fmt::format("![{0}: {1}]({0}_{1}.svg)\n", run.name, picture);
    for (const MarkerMotion& other : of_kind(others, run))
      pictures += fmt::format("![{0} by {1}: quiver]({0}_{1}_quiver.svg)\n", run.name, other.name);
  }
  return fmt::format(kMarkerCurvePage, config.chosen.first_row, config.chosen.last_row, config.chosen.first_column,
                     config.chosen.last_column, 100.0 * config.settled_load, evenness, loads, compared, pictures);
}

}  // namespace tacipc::verify
