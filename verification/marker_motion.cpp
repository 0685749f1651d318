#include "verification/marker_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/base/units.h"
#include "common/format/html_text.h"
#include "common/image/svg.h"
#include "common/sample/press_folder.h"
#include "common/sensor/markers.h"

namespace tacipc::verify {
namespace {

/// Rotation of the object about z from the first to the second pose, rad.
double turn_between(const Eigen::Matrix4d& from, const Eigen::Matrix4d& to) {
  const Eigen::Matrix3d turn = to.topLeftCorner<3, 3>() * from.topLeftCorner<3, 3>().transpose();
  return std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
}

std::vector<std::size_t> chosen_of(const MarkerMotion& motion, const MarkerChoice& chosen) {
  std::vector<std::size_t> out;
  for (std::size_t m = 0; m < motion.rows.size(); ++m)
    if (chosen.has(motion.rows[m], motion.columns[m])) out.push_back(m);
  if (out.empty())
    throw DataError("{}: no marker is in rows {} to {} and columns {} to {}", motion.name, chosen.first_row,
                    chosen.last_row, chosen.first_column, chosen.last_column);
  return out;
}

std::vector<double> mean_lengths(const std::vector<Eigen::Matrix2Xd>& frames, const std::vector<std::size_t>& chosen) {
  std::vector<double> means;
  for (const Eigen::Matrix2Xd& displacement : frames) {
    double sum = 0.0;
    for (const std::size_t m : chosen) sum += displacement.col(m).norm();
    means.push_back(sum / static_cast<double>(chosen.size()));
  }
  return means;
}

}  // namespace

MarkerChoice MarkerChoice::read(ConfigReader& in) {
  MarkerChoice chosen;
  ConfigReader rows = in.section("rows"), columns = in.section("columns");
  chosen.first_row = rows.integer("first", 0);
  chosen.last_row = rows.integer("last", chosen.first_row);
  chosen.first_column = columns.integer("first", 0);
  chosen.last_column = columns.integer("last", chosen.first_column);
  return chosen;
}

MarkerMotion read_marker_motion(const std::filesystem::path& folder, const std::string& name, std::size_t frames,
                                std::size_t press_end) {
  MarkerMotion motion;
  motion.name = name;
  motion.press_end_frame = static_cast<int>(press_end);
  for (const MarkerPlace& place : read_marker_places(folder / kMarkersCsv)) {
    motion.rows.push_back(place.row);
    motion.columns.push_back(place.column);
  }
  const std::size_t count = motion.rows.size();
  const PressFolder press(folder, {{kFrames, frames}, {kMarkers, count}});
  const std::vector<Matrix4> poses = press.poses();
  const Positions rest = press.markers(0), at_press_end = press.markers(press_end);
  const Matrix4 &start = poses[press_end], &last = poses[frames - 1];
  const Eigen::Vector2d dragged = (last - start).block<2, 1>(0, 3);
  motion.turns = std::abs(turn_between(start, last)) > 1e-9;
  if (!motion.turns && !(dragged.norm() > 0.0))
    throw DataError("{}: the object neither slides nor turns after the press", folder.string());

  motion.rest = rest.leftCols<2>().transpose();
  for (std::size_t f = press_end; f < frames; ++f) {
    const Matrix4& at = poses[f];
    motion.way.push_back(motion.turns ? std::abs(turn_between(start, at)) : (at - start).block<2, 1>(0, 3).norm());
    Eigen::Matrix2Xd carried(2, static_cast<Eigen::Index>(count));
    const Eigen::Matrix4d moved_by = at * start.inverse();
    for (Eigen::Index m = 0; m < carried.cols(); ++m) {
      Eigen::Vector4d pressed(0.0, 0.0, 0.0, 1.0);
      pressed.head<3>() = at_press_end.row(m).transpose();
      carried.col(m) = (moved_by * pressed - pressed).head<2>();
    }
    motion.markers.emplace_back(press.marker_displacements(f).since_press.leftCols<2>().transpose());
    motion.carried.push_back(std::move(carried));
  }
  return motion;
}

MarkerMotion read_other_motion(const std::filesystem::path& folder) {
  const PressFolder press(folder);
  const std::vector<PhaseKind> phases = press.phases();
  const auto last = std::find(phases.rbegin(), phases.rend(), PhaseKind::press);
  const auto end = static_cast<std::size_t>(phases.rend() - last) - 1;
  if (last == phases.rend() || end + 1 >= phases.size())
    throw DataError("{}: nothing follows a press", press.path(PressArray::phase).string());
  std::string name = std::filesystem::absolute(folder / "").lexically_normal().parent_path().filename().string();
  if (std::filesystem::exists(folder / (name + ".yaml")))
    if (ConfigReader record = ConfigReader::from_file(folder / (name + ".yaml")); record.has("stage"))
      name = record.text("stage");
  return read_marker_motion(folder, name, phases.size(), end);
}

std::vector<double> mean_displacements(const MarkerMotion& motion, const MarkerChoice& chosen) {
  return mean_lengths(motion.markers, chosen_of(motion, chosen));
}

std::vector<double> mean_of_carried(const MarkerMotion& motion, const MarkerChoice& chosen) {
  return mean_lengths(motion.carried, chosen_of(motion, chosen));
}

double longest_displacement(const MarkerMotion& motion) { return motion.markers.back().colwise().norm().maxCoeff(); }

MotionComparison compare(const MarkerMotion& ours, const MarkerMotion& other, const MarkerChoice& choice) {
  const double way = ours.way.back();
  constexpr double kRounding = 1e-9;
  const auto next = std::ranges::find_if(other.way, [&](double w) { return w >= way * (1.0 - kRounding); });
  if (next == other.way.end() || next == other.way.begin())
    throw DataError("{}: goes {:g}, {} goes {:g}", other.name, other.way.back(), ours.name, way);
  const auto after = static_cast<std::size_t>(next - other.way.begin());
  const double from = other.way[after - 1];
  const double part = std::min(1.0, (way - from) / (other.way[after] - from));
  const Eigen::Matrix2Xd theirs = (1.0 - part) * other.markers[after - 1] + part * other.markers[after];
  MotionComparison out;
  double our_sum = 0.0, their_sum = 0.0;
  const std::vector<std::size_t> chosen = chosen_of(ours, choice);
  for (const std::size_t m : chosen) {
    std::size_t same = 0;
    while (same < other.rows.size() && (other.rows[same] != ours.rows[m] || other.columns[same] != ours.columns[m]))
      ++same;
    if (same == other.rows.size())
      throw DataError("{}: has no marker in row {}, column {}", other.name, ours.rows[m], ours.columns[m]);
    const Eigen::Vector2d our = ours.markers.back().col(m);
    const Eigen::Vector2d their = theirs.col(same);
    our_sum += our.norm();
    their_sum += their.norm();
    out.error_m += (their - our).norm() / static_cast<double>(chosen.size());
    out.largest_m = std::max(out.largest_m, (their - our).norm());
  }
  out.mean_m = their_sum / static_cast<double>(chosen.size());
  out.ratio = our_sum > 0.0 ? their_sum / our_sum : 0.0;
  return out;
}

std::string marker_quiver_svg(const MarkerMotion& motion, const MarkerChoice& chosen, std::optional<double> longest_m) {
  constexpr double kSide = 420.0, kEdge = 30.0;
  const Eigen::Matrix2Xd& moved = motion.markers.back();
  const Eigen::Vector2d low = motion.rest.rowwise().minCoeff(), high = motion.rest.rowwise().maxCoeff();
  const double extent = std::max(1e-12, (high - low).maxCoeff());
  const double largest = std::max(1e-12, longest_displacement(motion));
  const double spacing = extent / std::max(1.0, std::sqrt(static_cast<double>(motion.rest.cols())) - 1.0);
  const double scale = 2.0 * spacing / longest_m.value_or(largest);
  const double px_per_m = (kSide - 2.0 * kEdge) / extent;
  const Eigen::Matrix2Xd at = (px_per_m * (motion.rest.colwise() - low)).array() + kEdge;
  const std::vector<std::size_t> counted = chosen_of(motion, chosen);
  const std::string dots = "stroke-linecap=\"round\" stroke";
  std::string out = svg_file_start(kSide, kSide + 40.0, 11);
  out += arrows_svg(at, scale * px_per_m * moved, "fill=\"none\" stroke=\"#c22626\"");
  out += dots_svg(at, dots + "=\"#999\" stroke-width=\"2.4\"");
  out += dots_svg(at(Eigen::all, counted), dots + "=\"#2c8a3c\" stroke-width=\"4.8\"");
  out += fmt::format(
      "<text x=\"{0:.1f}\" y=\"{1:.1f}\" text-anchor=\"middle\">{2}: mean of the green markers {3:.0f} um, longest "
      "{4:.0f} um<tspan x=\"{0:.1f}\" dy=\"14\">arrows drawn {5:.1f} times as long</tspan></text>\n</svg>\n",
      kSide / 2, kSide + 12.0, html_text(motion.name), mean_displacements(motion, chosen).back() / kMicrometre,
      largest / kMicrometre, scale);
  return out;
}

std::string marker_vectors_csv(const MarkerMotion& motion) {
  std::string out = "frame,marker,row,column,x_mm,y_mm,dx_um,dy_um\n";
  for (std::size_t f = 0; f < motion.markers.size(); ++f)
    for (std::size_t m = 0; m < motion.rows.size(); ++m) {
      const auto i = static_cast<Eigen::Index>(m);
      out += fmt::format("{},{},{},{},{:.6g},{:.6g},{:.4f},{:.4f}\n", motion.press_end_frame + static_cast<int>(f), m,
                         motion.rows[m], motion.columns[m], motion.rest(0, i) / kMillimetre,
                         motion.rest(1, i) / kMillimetre, motion.markers[f](0, i) / kMicrometre,
                         motion.markers[f](1, i) / kMicrometre);
    }
  return out;
}

}  // namespace tacipc::verify
