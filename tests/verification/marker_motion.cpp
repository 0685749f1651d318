#include "tests/verification/marker_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "common/error.h"
#include "common/files.h"
#include "common/npy.h"

namespace tacipc::verify {
namespace {

constexpr double kMillimetre = 1e-3, kMicrometre = 1e-6;
constexpr double kPressPhase = 2;  // of phase.npy

/// Rows and columns of the markers, from the first columns of markers.csv after its header.
void read_marker_grid(const std::filesystem::path& file, MarkerMotion& motion) {
  std::istringstream lines(read_file(file));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    int marker = 0, row = 0, column = 0;
    if (std::sscanf(line.c_str(), "%d,%d,%d,", &marker, &row, &column) != 3)
      throw DataError("{}: line '{}' does not begin with marker, row and column", file.string(), line);
    motion.rows.push_back(row);
    motion.columns.push_back(column);
  }
}

/// Turn of the object about z from the first to the second pose, rad.
double turn_between(const Eigen::Matrix4d& from, const Eigen::Matrix4d& to) {
  const Eigen::Matrix3d turn = to.topLeftCorner<3, 3>() * from.topLeftCorner<3, 3>().transpose();
  return std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
}

using Pose = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

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
    for (const std::size_t m : chosen) sum += displacement.col(static_cast<Eigen::Index>(m)).norm();
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
  read_marker_grid(folder / "markers.csv", motion);
  const std::size_t count = motion.rows.size();
  const NpyArray poses = read_npy(folder / "object_pose.npy", {frames, 4, 4});
  const NpyArray moved = read_npy(folder / "marker_displacement.npy", {frames, count, 2, 3});
  const NpyArray markers = read_npy(folder / "markers.npy", {frames, count, 3});
  const auto pose = [&](std::size_t f) { return Eigen::Matrix4d(Eigen::Map<const Pose>(poses.data.data() + 16 * f)); };
  const Eigen::Matrix4d start = pose(press_end), last = pose(frames - 1);
  const Eigen::Vector2d dragged = (last - start).block<2, 1>(0, 3);
  motion.turns = std::abs(turn_between(start, last)) > 1e-9;
  if (!motion.turns && !(dragged.norm() > 0.0))
    throw DataError("{}: the object neither slides nor turns after the press", folder.string());

  motion.rest.resize(2, static_cast<Eigen::Index>(count));
  for (std::size_t m = 0; m < count; ++m)
    motion.rest.col(static_cast<Eigen::Index>(m)) << markers.data[3 * m], markers.data[3 * m + 1];
  for (std::size_t f = press_end; f < frames; ++f) {
    const Eigen::Matrix4d at = pose(f);
    motion.way.push_back(motion.turns ? std::abs(turn_between(start, at)) : (at - start).block<2, 1>(0, 3).norm());
    Eigen::Matrix2Xd displacement(2, static_cast<Eigen::Index>(count));
    Eigen::Matrix2Xd carried(2, static_cast<Eigen::Index>(count));
    const Eigen::Matrix4d moved_by = at * start.inverse();
    for (std::size_t m = 0; m < count; ++m) {
      const double* d = moved.data.data() + ((f * count + m) * 2 + 1) * 3;
      displacement.col(static_cast<Eigen::Index>(m)) << d[0], d[1];
      const double* p = markers.data.data() + (press_end * count + m) * 3;
      const Eigen::Vector4d pressed(p[0], p[1], p[2], 1.0);
      carried.col(static_cast<Eigen::Index>(m)) = (moved_by * pressed - pressed).head<2>();
    }
    motion.markers.push_back(std::move(displacement));
    motion.carried.push_back(std::move(carried));
  }
  return motion;
}

MarkerMotion read_other_motion(const std::filesystem::path& folder) {
  const NpyArray phase = read_npy(folder / "phase.npy");
  const auto press = std::find_if(phase.data.rbegin(), phase.data.rend(), [](double p) { return p == kPressPhase; });
  const auto end = static_cast<std::size_t>(phase.data.rend() - press) - 1;
  if (press == phase.data.rend() || end + 1 >= phase.data.size())
    throw DataError("{}: nothing follows a press", (folder / "phase.npy").string());
  std::string name = std::filesystem::absolute(folder / "").lexically_normal().parent_path().filename().string();
  if (std::filesystem::exists(folder / (name + ".yaml")))
    if (ConfigReader record = ConfigReader::from_file(folder / (name + ".yaml")); record.has("stage"))
      name = record.text("stage");
  return read_marker_motion(folder, name, phase.data.size(), end);
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
  const auto next =
      std::find_if(other.way.begin(), other.way.end(), [&](double w) { return w >= way * (1.0 - kRounding); });
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
    const Eigen::Vector2d our = ours.markers.back().col(static_cast<Eigen::Index>(m));
    const Eigen::Vector2d their = theirs.col(static_cast<Eigen::Index>(same));
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
  const auto px = [&](double v, double from) { return kEdge + (v - from) / extent * (kSide - 2.0 * kEdge); };
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" "
      "font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"white\"/>\n",
      kSide, kSide + 40.0);
  for (Eigen::Index m = 0; m < moved.cols(); ++m) {
    const Eigen::Vector2d from = motion.rest.col(m), to = from + scale * moved.col(m);
    const auto i = static_cast<std::size_t>(m);
    if (moved.col(m).norm() > 0.01 * largest)
      out += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#c22626\"/>", px(from.x(), low.x()),
                         px(from.y(), low.y()), px(to.x(), low.x()), px(to.y(), low.y()));
    const bool counts = chosen.has(motion.rows[i], motion.columns[i]);
    out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", px(from.x(), low.x()),
                       px(from.y(), low.y()), counts ? "2.4" : "1.2", counts ? "#2c8a3c" : "#999");
  }
  out += fmt::format(
      "<text x=\"{0:.1f}\" y=\"{1:.1f}\" text-anchor=\"middle\">{2}: mean of the green markers {3:.0f} um, longest "
      "{4:.0f} um"
      "<tspan x=\"{0:.1f}\" dy=\"14\">lines drawn {5:.1f} times as long</tspan></text>\n</svg>\n",
      kSide / 2, kSide + 12.0, motion.name, mean_displacements(motion, chosen).back() / kMicrometre,
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
