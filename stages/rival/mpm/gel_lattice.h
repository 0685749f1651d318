// The gel as a regular lattice of particles, and its top layer as a surface.
#pragma once

#include <array>
#include <vector>

#include "common/base/types.h"
#include "common/sensor/sensor.h"
#include "stages/rival/mpm/mpm_config.h"

namespace tacipc {

/// Particle `layer · columns + column`; layer 0 is the lowest, the columns go along y within rows of x.
struct GelLattice {
  double spacing_m = 0.0;
  double thickness_m = 0.0;  // of the gel
  int layers = 0;
  std::array<int, 2> sides{};               // of the smallest rectangle of columns around the gel
  std::vector<std::array<int, 2>> columns;  // (i, j) in that rectangle
  std::vector<int> column_at;               // of i · sides[1] + j; −1 beside the gel
  Positions rest_m;                         // every particle, frame S

  int num_columns() const { return static_cast<int>(columns.size()); }
  int first_of_top() const { return (layers - 1) * num_columns(); }
  /// Column at (i, j); −1 beside the gel.
  int at(int i, int j) const {
    if (i < 0 || j < 0 || i >= sides[0] || j >= sides[1]) return -1;
    return column_at[i * sides[1] + j];
  }
};

/// Fills the configuration's block or the sensor's gel. \throw DataError if the gel is domed, its thickness is no
/// multiple of the spacing, it is too small for two columns each way, or fewer layers remain than are fixed.
GelLattice make_gel_lattice(const LatticeConfig& config, const GelShape& gel);

/// The front at rest: the top layer's columns at z = 0.
Positions front_at_rest(const GelLattice& lattice);

/// Each square of four columns as two triangles that look up, each corner of three as one: rows into the columns.
/// Squares are cut along the diagonal that Delaunay's triangulation of `positions` has, seen from above; where both
/// would do, from the corner with the smallest i and j.
Triangles triangulate(const GelLattice& lattice, const Positions& positions);

}  // namespace tacipc
