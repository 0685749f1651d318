// Tetrahedra between the points of a lattice of cells: boxes, and discs with rings at chosen radii.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "common/mesh/tet_mesh.h"

namespace tacipc::verify {

using LatticePoint = std::array<int, 3>;

/// A block of cells whose corners are the points (i, j, k), 0 ≤ i ≤ cells[0] and so on. Points that are one place (a
/// closed ring, an axis) have the same representative; what touches a point without one is left out.
struct Lattice {
  LatticePoint cells;
  LatticePoint shift{0, 0, 0};  // which cells of an axis are walked upwards: those of even index, or (1) of odd
  std::function<std::optional<LatticePoint>(const LatticePoint&)> representative;
  std::function<Vector3(const LatticePoint&)> position;  // m, of a representative
};

/// Each cell is six tetrahedra (Kuhn), mirrored from cell to cell so that no direction is preferred; those that the
/// representatives flatten are left out. Positive volumes; vertices that nothing uses are dropped. A ring that closes
/// along an axis needs an even number of cells there. No boundary, no tags.
TetMesh fill_lattice(const Lattice& lattice);

}  // namespace tacipc::verify
