// Simulated presses of one ball to several depths, each followed by a shear: displacements at any depth and travel.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// Markers at rest on a lattice parallel to the axes of S, in any order.
class MarkerLattice {
 public:
  /// Builds the lattice from rest positions, m.
  /// \throw DataError, naming `source`, if they are not a full lattice of at least 4 × 4, within a thousandth of its
  /// spacing
  MarkerLattice(const Positions& rest_m, const std::string& source);

  /// Interpolates the displacement at a point of the undeformed front, m, from the `vectors` of all markers: cubic in
  /// each direction (Catmull–Rom), with one-sided slopes in the outermost cells.
  /// \throw DataError if the point lies outside the lattice
  Vector3 at(const Eigen::Vector2d& point_m, const Positions& vectors) const;

 private:
  std::string source_;
  Eigen::Vector2d first_m_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d spacing_m_ = Eigen::Vector2d::Zero();
  Eigen::Vector2i count_ = Eigen::Vector2i::Zero();  // columns, rows
  Eigen::MatrixXi marker_;                           // row, column → marker
};

/// One press and shear, as read from the files of `press` or another simulator.
struct PressedRun {
  std::string source;
  MarkerLattice lattice;
  std::vector<Positions> displacement_m = {};                   // displacement of the markers since rest, per frame
  Eigen::Vector2d place_m = Eigen::Vector2d::Zero();            // position of the ball at the end of the press
  std::vector<std::size_t> press_frame = {}, shear_frame = {};  // ascending; the shear starts at the end of the press
  std::vector<double> depth_m = {};                             // depth in each press frame
  std::vector<double> way_m = {};                               // travel in each shear frame

  double final_depth_m() const { return depth_m.back(); }
};

/// Press runs of one ball, in order of ascending depth.
class PressedRuns {
 public:
  /// Reads every folder at or below `folders` that holds marker_displacement.npy, with markers.npy, object_pose.npy and
  /// phase.npy. The depth is the ball's radius minus the height of its centre, the origin of the object's frame.
  /// \throw DataError if files do not fit together, no shear follows a press, or there are fewer than two depths
  PressedRuns(const std::vector<std::filesystem::path>& folders, double ball_radius_m);

  double deepest_m() const { return runs_.back().final_depth_m(); }
  double shallowest_m() const { return runs_.front().final_depth_m(); }
  double longest_way_m() const;

  /// Returns displacements since rest, m, after a press to a depth, at points relative to the ball's axis, m.
  /// Interpolates linearly between the frames of the deepest press.
  /// \pre 0 ≤ depth_m ≤ deepest_m()
  Eigen::Matrix3Xd pressed(const Eigen::Matrix2Xd& from_axis_m, double depth_m) const;
  /// Returns displacements since rest after a press and a shear by `way_m`. Interpolates linearly between the frames of
  /// a run and between the two runs next to the depth.
  /// \pre shallowest_m() ≤ depth_m ≤ deepest_m(), 0 ≤ way_m ≤ longest_way_m()
  Eigen::Matrix3Xd sheared(const Eigen::Matrix2Xd& from_axis_m, double depth_m, double way_m) const;

 private:
  std::vector<PressedRun> runs_;
};

}  // namespace tacipc
