// The gel as a regular lattice of particles, and its top layer as a surface.
#pragma once

#include <array>
#include <vector>

#include "common/base/types.h"
#include "common/sensor/sensor.h"
#include "stages/rival/mpm/mpm_config.h"

namespace tacipc {

/// Regular lattice of particles. Particle index: `layer · columns + column`; layer 0 is the lowest, and columns run
/// along y within rows of x.
struct GelLattice {
  double spacing_m = 0.0;
  double thickness_m = 0.0;  // thickness of the gel
  int layers = 0;
  std::array<int, 2> sides{};               // sides of the smallest rectangle of columns around the gel
  std::vector<std::array<int, 2>> columns;  // position (i, j) of each column in that rectangle
  std::vector<int> column_at;               // column at i · sides[1] + j; −1 outside the gel
  Positions rest_m;                         // positions of all particles at rest, frame S

  int num_columns() const { return static_cast<int>(columns.size()); }
  int first_of_top() const { return (layers - 1) * num_columns(); }
  /// Column at (i, j); −1 outside the gel.
  int at(int i, int j) const {
    if (i < 0 || j < 0 || i >= sides[0] || j >= sides[1]) return -1;
    return column_at[i * sides[1] + j];
  }
};

/// Fills the configuration's block or the sensor's gel.
/// \throw DataError if the gel is domed, its thickness is not a multiple of the spacing, it is too small for two
/// columns each way, or it has fewer layers than are fixed
GelLattice make_gel_lattice(const LatticeConfig& config, const GelShape& gel);

/// Front at rest: the top layer's columns at z = 0.
Positions front_at_rest(const GelLattice& lattice);

/// Triangles of the front, as rows of column indices: each square of four columns gives two upward triangles, each
/// corner of three gives one. Squares are cut along the diagonal of the Delaunay triangulation of `positions`, seen
/// from above; if both diagonals qualify, along the one from the corner with the smallest i and j.
Triangles triangulate(const GelLattice& lattice, const Positions& positions);

}  // namespace tacipc
