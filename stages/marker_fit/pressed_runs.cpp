#include "stages/marker_fit/pressed_runs.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "common/error.h"
#include "common/npy.h"

namespace tacipc {
namespace {

constexpr double kPressPhase = 2, kShearPhase = 3;  // of phase.npy; below: reference and approach

PressedRun read_run(const std::filesystem::path& folder, double ball_radius_m) {
  const NpyArray phase = read_npy(folder / "phase.npy");
  if (phase.shape.size() != 1) throw DataError("{}: has another shape than (frames,)", (folder / "phase.npy").string());
  const std::size_t frames = phase.shape[0];
  const NpyArray markers = read_npy(folder / "markers.npy");
  if (markers.shape.size() != 3 || markers.shape[0] != frames || markers.shape[2] != 3)
    throw DataError("{}: has another shape than ({}, markers, 3)", (folder / "markers.npy").string(), frames);
  const std::size_t count = markers.shape[1];
  PressedRun run{.source = folder.string(),
                 .lattice = MarkerLattice(std::span(markers.data).first(3 * count), (folder / "markers.npy").string()),
                 .num_markers = count};
  NpyArray moved = read_npy(folder / "marker_displacement.npy", {frames, run.num_markers, 2, 3});
  run.displacement_m = std::move(moved.data);
  const NpyArray pose = read_npy(folder / "object_pose.npy", {frames, 4, 4});
  const auto place = [&](std::size_t f) {
    return Eigen::Vector3d(pose.data[16 * f + 3], pose.data[16 * f + 7], pose.data[16 * f + 11]);
  };
  for (std::size_t f = 0; f < frames; ++f) {
    if (phase.data[f] <= kPressPhase) {
      run.press_frame.push_back(f);
      run.depth_m.push_back(ball_radius_m - place(f).z());
    } else if (phase.data[f] == kShearPhase) {
      if (run.shear_frame.empty()) run.shear_frame.push_back(f - 1);
      run.shear_frame.push_back(f);
    }
  }
  if (run.press_frame.size() < 2 || run.shear_frame.empty() || run.shear_frame.front() != run.press_frame.back())
    throw DataError("{}: is no press followed by a shear", folder.string());
  const Eigen::Vector3d end = place(run.press_frame.back());
  run.place_m = end.head<2>();
  for (const std::size_t f : run.shear_frame) run.way_m.push_back((place(f) - end).head<2>().norm());
  if (!std::is_sorted(run.depth_m.begin(), run.depth_m.end()) || !std::is_sorted(run.way_m.begin(), run.way_m.end()))
    throw DataError("{}: the ball goes back on its way", folder.string());
  return run;
}

/// Between which two of ascending values a value lies: the first's index, and how far towards the second.
std::pair<std::size_t, double> between(const std::vector<double>& values, double value) {
  const auto above = std::upper_bound(values.begin() + 1, values.end() - 1, value);
  const auto i = static_cast<std::size_t>(above - values.begin()) - 1;
  const double width = values[i + 1] - values[i];
  return {i, width > 0.0 ? std::clamp((value - values[i]) / width, 0.0, 1.0) : 0.0};
}

Eigen::Matrix2Xd frame_at(const PressedRun& run, std::size_t frame, const Eigen::Matrix2Xd& from_axis_m) {
  const double* vectors = run.displacement_m.data() + frame * run.num_markers * 6;  // [0] of two: since rest
  Eigen::Matrix2Xd out(2, from_axis_m.cols());
  for (Eigen::Index i = 0; i < out.cols(); ++i)
    out.col(i) = run.lattice.at(run.place_m + from_axis_m.col(i), vectors, 6);
  return out;
}

Eigen::Matrix2Xd blend(const PressedRun& run, const std::vector<std::size_t>& frames, std::pair<std::size_t, double> at,
                       const Eigen::Matrix2Xd& from_axis_m) {
  const auto& [i, part] = at;
  return (1.0 - part) * frame_at(run, frames[i], from_axis_m) + part * frame_at(run, frames[i + 1], from_axis_m);
}

}  // namespace

PressedRuns::PressedRuns(const std::filesystem::path& folder, double ball_radius_m) {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().filename() == "marker_displacement.npy") found.push_back(entry.path().parent_path());
  std::sort(found.begin(), found.end());
  for (const auto& run : found) runs_.push_back(read_run(run, ball_radius_m));
  std::stable_sort(runs_.begin(), runs_.end(),
                   [](const PressedRun& a, const PressedRun& b) { return a.final_depth_m() < b.final_depth_m(); });
  for (std::size_t i = 1; i < runs_.size(); ++i)
    if (!(runs_[i].final_depth_m() > runs_[i - 1].final_depth_m()))
      throw DataError("{}: is pressed as deep as {}", runs_[i].source, runs_[i - 1].source);
  if (runs_.size() < 2) throw DataError("{}: has presses to fewer than two depths", folder.string());
}

double PressedRuns::longest_way_m() const {
  double way = runs_.front().way_m.back();
  for (const PressedRun& run : runs_) way = std::min(way, run.way_m.back());
  return way;
}

Eigen::Matrix2Xd PressedRuns::pressed(const Eigen::Matrix2Xd& from_axis_m, double depth_m) const {
  const PressedRun& run = runs_.back();
  return blend(run, run.press_frame, between(run.depth_m, depth_m), from_axis_m);
}

Eigen::Matrix2Xd PressedRuns::sheared(const Eigen::Matrix2Xd& from_axis_m, double depth_m, double way_m) const {
  std::vector<double> depths;
  for (const PressedRun& run : runs_) depths.push_back(run.final_depth_m());
  const auto [i, part] = between(depths, depth_m);
  const auto of = [&](const PressedRun& run) {
    return blend(run, run.shear_frame, between(run.way_m, way_m), from_axis_m);
  };
  return (1.0 - part) * of(runs_[i]) + part * of(runs_[i + 1]);
}

}  // namespace tacipc
