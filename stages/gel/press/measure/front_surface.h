// The front face as a surface of its own: it touches the object, has the markers and is measured.
#pragma once

#include <vector>

#include "common/mesh/tet_mesh.h"

namespace tacipc {

/// Vertices and triangles of the front. Arrays per front vertex have one row per entry of `vertices`.
struct FrontSurface {
  std::vector<int> vertices;  // rows of the gel's positions, ascending
  Triangles triangles;        // indices into `vertices`, outwards
};

/// Median edge length of the front face, m: the resolution of contact.
double median_front_edge_m(const TetMesh& gel);

/// Surface of the triangles that are tagged as front.
FrontSurface make_front_surface(const TetMesh& gel);

/// Rows of the front vertices in a per-vertex array of the whole gel.
Positions on_front(const FrontSurface& front, const Positions& of_gel);

/// Area of each triangle at the given front positions, m².
std::vector<double> triangle_areas(const FrontSurface& front, const Positions& front_positions);

/// A third of the areas of the triangles around each front vertex, m²; the sum is the area of the front.
std::vector<double> lumped_areas(const FrontSurface& front, const Positions& front_positions);

}  // namespace tacipc
