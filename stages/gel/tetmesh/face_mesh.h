// Even triangulation of one face of the gel: points scattered at random, then pushed apart until their distances match
// the target, so that no lattice shows in images of the gel.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "common/sensor/sensor.h"
#include "stages/gel/tetmesh/delaunay.h"

namespace tacipc {

/// A face of the gel over the plane: its shape and its target edge lengths.
struct Face {
  GelShape gel;
  std::optional<double> dome_radius_m;                  // radius of this face's dome; absent: flat
  std::function<double(const Vector2&)> height_m;       // z over (x, y)
  std::function<double(const Vector2&)> edge_length_m;  // target edge length at (x, y), measured in space
};

/// A triangulated face.
struct FaceMesh {
  std::vector<Vector2> points;  // the rim points first, as given
  Triangles triangles;          // counter-clockwise seen along −z
};

/// Fills the rim with points and triangulates them. Points come from dart throwing (no two nearer than a fraction of
/// the target length) and relaxation by repulsive springs on the current Delaunay edges (Persson and Strang, A Simple
/// Mesh Generator in MATLAB, 2004). The density is corrected until the mean of (edge length / target length) is 1
/// within 1.5 %.
/// \param rim counter-clockwise loop of points on the outline
FaceMesh mesh_face(const Face& face, const std::vector<Vector2>& rim, std::uint64_t seed);

/// Distinct edges (i < j) of triangles, ascending.
std::vector<std::pair<int, int>> unique_edges(const Triangles& triangles);

}  // namespace tacipc
