#include "common/benchmark/pressed_runs.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "common/base/error.h"
#include "common/sample/press_folder.h"

namespace tacipc {
namespace {

PressedRun read_run(const std::filesystem::path& folder, double ball_radius_m) {
  PressFolder press(folder);
  const std::vector<PhaseKind> phases = press.phases();
  const std::vector<Matrix4> poses = press.poses();
  PressedRun run{.source = folder.string(),
                 .lattice = MarkerLattice(press.markers(0), press.path(PressArray::markers).string())};
  const auto place = [&](std::size_t f) -> Vector3 { return poses[f].topRightCorner<3, 1>(); };
  for (std::size_t f = 0; f < phases.size(); ++f) {
    run.displacement_m.push_back(press.marker_displacements(f).since_rest);
    if (phases[f] <= PhaseKind::press) {
      run.press_frame.push_back(f);
      run.depth_m.push_back(ball_radius_m - place(f).z());
    } else if (phases[f] == PhaseKind::shear) {
      if (run.shear_frame.empty()) run.shear_frame.push_back(f - 1);
      run.shear_frame.push_back(f);
    }
  }
  if (run.press_frame.size() < 2 || run.shear_frame.empty() || run.shear_frame.front() != run.press_frame.back())
    throw DataError("{}: is not a press followed by a shear", folder.string());
  const Vector3 end = place(run.press_frame.back());
  run.place_m = end.head<2>();
  for (const std::size_t f : run.shear_frame) run.way_m.push_back((place(f) - end).head<2>().norm());
  if (!std::ranges::is_sorted(run.depth_m) || !std::ranges::is_sorted(run.way_m))
    throw DataError("{}: the ball reverses its motion", folder.string());
  return run;
}

/// Returns the interval of ascending values that contains a value: index of its first end, and fraction towards the
/// second.
std::pair<std::size_t, double> between(const std::vector<double>& values, double value) {
  const auto above = std::upper_bound(values.begin() + 1, values.end() - 1, value);
  const auto i = static_cast<std::size_t>(above - values.begin()) - 1;
  const double width = values[i + 1] - values[i];
  return {i, width > 0.0 ? std::clamp((value - values[i]) / width, 0.0, 1.0) : 0.0};
}

Eigen::Matrix3Xd frame_at(const PressedRun& run, std::size_t frame, const Eigen::Matrix2Xd& from_axis_m) {
  Eigen::Matrix3Xd out(3, from_axis_m.cols());
  for (Eigen::Index i = 0; i < out.cols(); ++i)
    out.col(i) = run.lattice.at(run.place_m + from_axis_m.col(i), run.displacement_m[frame]);
  return out;
}

Eigen::Matrix3Xd blend(const PressedRun& run, const std::vector<std::size_t>& frames, std::pair<std::size_t, double> at,
                       const Eigen::Matrix2Xd& from_axis_m) {
  const auto& [i, part] = at;
  return (1.0 - part) * frame_at(run, frames[i], from_axis_m) + part * frame_at(run, frames[i + 1], from_axis_m);
}

constexpr double kTolerance = 1e-3;  // fraction of the spacing

/// Returns distinct values of ascending ones.
std::vector<double> distinct(std::vector<double> values) {
  std::ranges::sort(values);
  const double tolerance = kTolerance * (values.back() - values.front()) / static_cast<double>(values.size());
  std::vector<double> out;
  for (const double v : values)
    if (out.empty() || v - out.back() > tolerance) out.push_back(v);
  return out;
}

/// Returns Catmull–Rom weights of four values at −1, 0, 1, 2 for a point at t in [0, 1].
std::array<double, 4> catmull_rom(double t) {
  return {0.5 * t * (-1.0 + t * (2.0 - t)), 1.0 + 0.5 * t * t * (-5.0 + 3.0 * t), 0.5 * t * (1.0 + t * (4.0 - 3.0 * t)),
          0.5 * t * t * (t - 1.0)};
}

}  // namespace

PressedRuns::PressedRuns(const std::vector<std::filesystem::path>& folders, double ball_radius_m) {
  std::vector<std::filesystem::path> found;
  for (const auto& folder : folders)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.path().filename() == field_of(PressArray::marker_displacement).file)
        found.push_back(entry.path().parent_path());
  std::ranges::sort(found);
  for (const auto& run : found) runs_.push_back(read_run(run, ball_radius_m));
  std::ranges::stable_sort(runs_, {}, &PressedRun::final_depth_m);
  for (std::size_t i = 1; i < runs_.size(); ++i)
    if (!(runs_[i].final_depth_m() > runs_[i - 1].final_depth_m()))
      throw DataError("{}: is pressed as deep as {}", runs_[i].source, runs_[i - 1].source);
  if (runs_.size() < 2) throw DataError("{}: has presses to fewer than two depths", folders.front().string());
}

double PressedRuns::longest_way_m() const {
  double way = runs_.front().way_m.back();
  for (const PressedRun& run : runs_) way = std::min(way, run.way_m.back());
  return way;
}

Eigen::Matrix3Xd PressedRuns::pressed(const Eigen::Matrix2Xd& from_axis_m, double depth_m) const {
  const PressedRun& run = runs_.back();
  return blend(run, run.press_frame, between(run.depth_m, depth_m), from_axis_m);
}

Eigen::Matrix3Xd PressedRuns::sheared(const Eigen::Matrix2Xd& from_axis_m, double depth_m, double way_m) const {
  std::vector<double> depths;
  for (const PressedRun& run : runs_) depths.push_back(run.final_depth_m());
  const auto [i, part] = between(depths, depth_m);
  const auto of = [&](const PressedRun& run) {
    return blend(run, run.shear_frame, between(run.way_m, way_m), from_axis_m);
  };
  return (1.0 - part) * of(runs_[i]) + part * of(runs_[i + 1]);
}

MarkerLattice::MarkerLattice(const Positions& rest_m, const std::string& source) : source_(source) {
  const auto no_lattice = [&] {
    throw DataError("{}: the markers at rest are not a lattice of rows and columns", source);
  };
  const Eigen::Index markers = rest_m.rows();
  if (markers < 16) no_lattice();
  for (int k = 0; k < 2; ++k) {
    const std::vector<double> lines = distinct({rest_m.col(k).begin(), rest_m.col(k).end()});
    if (lines.size() < 4) no_lattice();
    first_m_[k] = lines.front();
    count_[k] = static_cast<int>(lines.size());
    spacing_m_[k] = (lines.back() - lines.front()) / static_cast<double>(lines.size() - 1);
  }
  if (Eigen::Index{count_.x()} * count_.y() != markers) no_lattice();
  marker_ = Eigen::MatrixXi::Constant(count_.y(), count_.x(), -1);
  for (Eigen::Index m = 0; m < markers; ++m) {
    const Eigen::Vector2d place = (rest_m.row(m).head<2>().transpose() - first_m_).cwiseQuotient(spacing_m_);
    const Eigen::Vector2d whole = place.array().round().matrix();
    if ((place - whole).cwiseAbs().maxCoeff() > kTolerance) no_lattice();
    int& here = marker_(static_cast<int>(whole.y()), static_cast<int>(whole.x()));
    if (here >= 0) no_lattice();
    here = static_cast<int>(m);
  }
}

Vector3 MarkerLattice::at(const Eigen::Vector2d& point_m, const Positions& vectors) const {
  const Eigen::Vector2d place = (point_m - first_m_).cwiseQuotient(spacing_m_);
  std::array<std::array<double, 4>, 2> weight{};
  Eigen::Vector2i cell;
  for (int k = 0; k < 2; ++k) {
    if (!(place[k] >= 0.0 && place[k] <= count_[k] - 1))
      throw DataError("{}: a measured marker at ({:.3f}, {:.3f}) mm lies outside the simulated ones", source_,
                      1e3 * point_m.x(), 1e3 * point_m.y());
    cell[k] = std::min(static_cast<int>(place[k]), count_[k] - 2);
    auto& w = weight[k] = catmull_rom(place[k] - cell[k]);
    // Beyond the edge the field is extrapolated linearly: v(−1) = 2 v(0) − v(1).
    if (cell[k] == 0) {
      w[1] += 2.0 * w[0];
      w[2] -= w[0];
      w[0] = 0.0;
    }
    if (cell[k] == count_[k] - 2) {
      w[2] += 2.0 * w[3];
      w[1] -= w[3];
      w[3] = 0.0;
    }
  }
  Vector3 sum = Vector3::Zero();
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const double w = weight[0][i] * weight[1][j];
      if (w == 0.0) continue;
      sum += w * vectors.row(marker_(cell.y() + j - 1, cell.x() + i - 1)).transpose();
    }
  return sum;
}

}  // namespace tacipc
