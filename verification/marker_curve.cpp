#include "verification/marker_curve.h"

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/sample/press_folder.h"
#include "common/sample/press_record.h"
#include "verification/stage_record.h"

namespace tacipc::verify {

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
    const double x = poses[f](0, 3), y = poses[f](1, 3);  // of the object's axis
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

}  // namespace tacipc::verify
