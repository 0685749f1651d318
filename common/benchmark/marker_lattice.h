// Simulated displacements between the markers they were computed at.
#pragma once

#include <Eigen/Core>
#include <string>

#include "common/base/types.h"

namespace tacipc {

/// Markers at rest on a lattice parallel to the axes of S, row by row or in any other order.
class MarkerLattice {
 public:
  /// From rest places, m. \throw DataError, naming `source`, if they are not a full lattice of
  /// at least 4 × 4, within a thousandth of its spacing
  MarkerLattice(const Positions& rest_m, const std::string& source);

  /// Displacement at a point of the undeformed front, m, from the `vectors` of all markers: cubic in
  /// each direction (Catmull and Rom's), its slopes one-sided in the outermost cells. \throw DataError if the point
  /// lies outside the lattice
  Vector3 at(const Eigen::Vector2d& point_m, const Positions& vectors) const;

 private:
  std::string source_;
  Eigen::Vector2d first_m_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d spacing_m_ = Eigen::Vector2d::Zero();
  Eigen::Vector2i count_ = Eigen::Vector2i::Zero();  // columns, rows
  Eigen::MatrixXi marker_;                           // row, column → marker
};

}  // namespace tacipc
