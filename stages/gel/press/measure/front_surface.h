// The front face as a surface of its own: what touches the object, carries markers and is measured.
#pragma once

#include <vector>

#include "common/mesh/tet_mesh.h"

namespace tacipc {

/// Vertices and triangles of the front. Arrays per front vertex have one row per entry of `vertices`.
struct FrontSurface {
  std::vector<int> vertices;  // rows of the gel's positions, ascending
  Triangles triangles;        // indices into `vertices`, outwards
};

/// Median length of the edges of the front face: how finely contact is resolved.
double median_front_edge_m(const TetMesh& gel);

FrontSurface make_front_surface(const TetMesh& gel);

/// The rows of a per-vertex array of the whole gel that belong to the front.
Positions on_front(const FrontSurface& front, const Positions& of_gel);

/// Area of each triangle at the given front positions, m².
std::vector<double> triangle_areas(const FrontSurface& front, const Positions& front_positions);

/// A third of the areas of the triangles around each front vertex, m²; they sum to the area of the front.
std::vector<double> lumped_areas(const FrontSurface& front, const Positions& front_positions);

}  // namespace tacipc
