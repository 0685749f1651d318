#include "tests/verification/marker_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/error.h"
#include "common/files.h"
#include "common/npy.h"
#include "tests/verification/stage_record.h"

namespace tacipc::verify {
namespace {

/// An array whose shape must begin with the number of frames and end as given.
NpyArray frames_of(const std::filesystem::path& file, std::size_t frames, const std::vector<std::size_t>& rest) {
  NpyArray array = read_npy(file);
  std::vector<std::size_t> wanted{frames};
  wanted.insert(wanted.end(), rest.begin(), rest.end());
  if (array.shape != wanted)
    throw DataError("{}: has the shape ({}), expected ({})", file.string(), fmt::join(array.shape, ", "),
                    fmt::join(wanted, ", "));
  return array;
}

/// Rows and columns of the markers, from the first two columns of markers.csv after its header.
void read_marker_grid(const std::filesystem::path& file, SlidingRun& run) {
  std::istringstream lines(read_file(file));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    int marker = 0, row = 0, column = 0;
    if (std::sscanf(line.c_str(), "%d,%d,%d,", &marker, &row, &column) != 3)
      throw DataError("{}: line '{}' does not begin with marker, row and column", file.string(), line);
    run.rows.push_back(row);
    run.columns.push_back(column);
  }
}

/// Turn of the object about z from the first to the second pose, rad.
double turn_between(const Eigen::Matrix4d& from, const Eigen::Matrix4d& to) {
  const Eigen::Matrix3d turn = to.topLeftCorner<3, 3>() * from.topLeftCorner<3, 3>().transpose();
  return std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
}

using Pose = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

}  // namespace

MarkerCurveConfig MarkerCurveConfig::read(ConfigReader& in) {
  MarkerCurveConfig config;
  ConfigReader rows = in.section("rows"), columns = in.section("columns");
  config.first_row = rows.integer("first", 0);
  config.last_row = rows.integer("last", config.first_row);
  config.first_column = columns.integer("first", 0);
  config.last_column = columns.integer("last", config.first_column);
  config.settled_load = in.number("settled_load", Range{.low = 0.0, .high = 1.0, .open_low = true, .open_high = true});
  config.second_difference_limit = in.number("second_difference_limit", Range::positive());
  return config;
}

SlidingRun read_sliding_run(const std::filesystem::path& press) {
  if (const auto failure = why_no_record(press, "press"))
    throw DataError("{}: the press did not come out: {}", press.lexically_normal().parent_path().filename().string(),
                    *failure);
  SlidingRun run;
  ConfigReader record = ConfigReader::from_file(press / "press.yaml");
  run.name = record.text("name");
  ConfigReader summary = record.section("summary");
  run.verdict = summary.text("verdict");
  run.gel_vertices = summary.integer("gel_vertices", 1);
  run.press_end_frame = summary.integer("press_end_frame", 1);
  run.max_balance_relative = summary.number("max_balance_relative");
  run.min_distance_m = summary.number("min_distance_m");
  run.min_volume_ratio = summary.number("min_volume_ratio");
  std::vector<ConfigReader> lines = summary.sections("per_frame");
  const std::size_t frames = lines.size(), end = static_cast<std::size_t>(run.press_end_frame);
  if (frames < end + 2) throw DataError("{}: nothing follows the press, which ends at frame {}", press.string(), end);

  read_marker_grid(press / "markers.csv", run);
  const std::size_t count = run.rows.size();
  const NpyArray poses = frames_of(press / "object_pose.npy", frames, {4, 4});
  const NpyArray wrench = frames_of(press / "wrench.npy", frames, {6});
  const NpyArray moved = frames_of(press / "marker_displacement.npy", frames, {count, 2, 3});
  const NpyArray markers = frames_of(press / "markers.npy", frames, {count, 3});
  const auto pose = [&](std::size_t f) { return Eigen::Matrix4d(Eigen::Map<const Pose>(poses.data.data() + 16 * f)); };
  const Eigen::Matrix4d start = pose(end), last = pose(frames - 1);
  const Eigen::Vector2d dragged = (last - start).block<2, 1>(0, 3);
  run.turns = std::abs(turn_between(start, last)) > 1e-9;
  if (!run.turns && !(dragged.norm() > 0.0))
    throw DataError("{}: the object neither slides nor turns after the press", press.string());

  run.rest.resize(2, static_cast<Eigen::Index>(count));
  for (std::size_t m = 0; m < count; ++m)
    run.rest.col(static_cast<Eigen::Index>(m)) << markers.data[3 * m], markers.data[3 * m + 1];
  for (std::size_t f = end; f < frames; ++f) {
    const Eigen::Matrix4d at = pose(f);
    run.way.push_back(run.turns ? std::abs(turn_between(start, at)) : (at - start).block<2, 1>(0, 3).norm());
    const double* w = wrench.data.data() + 6 * f;
    run.press_force_n.push_back(0.0 - w[2]);
    run.load.push_back(run.turns ? std::abs(w[5] - (at(0, 3) * w[1] - at(1, 3) * w[0])) : std::hypot(w[0], w[1]));
    const double sticking = lines[f].number("sticking"), slipping = lines[f].number("slipping");
    run.sticking.push_back(sticking + slipping > 0.0 ? sticking / (sticking + slipping) : 0.0);
    if (f > end && !run.gross_slip_way && slipping > 0.0 && sticking == 0.0) run.gross_slip_way = run.way.back();
    Eigen::Matrix2Xd displacement(2, static_cast<Eigen::Index>(count));
    for (std::size_t m = 0; m < count; ++m) {
      const double* d = moved.data.data() + ((f * count + m) * 2 + 1) * 3;
      displacement.col(static_cast<Eigen::Index>(m)) << d[0], d[1];
    }
    run.markers.push_back(std::move(displacement));
  }
  return run;
}

MarkerCurve marker_curve(const SlidingRun& run, const MarkerCurveConfig& config) {
  std::vector<Eigen::Index> chosen;
  for (std::size_t m = 0; m < run.rows.size(); ++m) {
    if (run.rows[m] >= config.first_row && run.rows[m] <= config.last_row && run.columns[m] >= config.first_column &&
        run.columns[m] <= config.last_column)
      chosen.push_back(static_cast<Eigen::Index>(m));
  }
  if (chosen.empty())
    throw DataError("{}: no marker is in rows {} to {} and columns {} to {}", run.name, config.first_row,
                    config.last_row, config.first_column, config.last_column);
  MarkerCurve curve;
  for (const Eigen::Matrix2Xd& displacement : run.markers) {
    double sum = 0.0;
    for (const Eigen::Index m : chosen) sum += displacement.col(m).norm();
    curve.mean_m.push_back(sum / static_cast<double>(chosen.size()));
  }
  const int frames = static_cast<int>(curve.mean_m.size());
  const double enough = config.settled_load * *std::max_element(run.load.begin(), run.load.end());
  for (int f = 0; f < frames; ++f)
    if (run.load[static_cast<std::size_t>(f)] < enough) curve.settled = f + 1;
  if (frames - curve.settled < 3)
    throw DataError("{}: sliding settles at frame {} of {} after the press: too late to judge", run.name, curve.settled,
                    frames - 1);
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
