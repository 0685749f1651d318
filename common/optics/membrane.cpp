#include "common/optics/membrane.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

#include "common/base/error.h"

namespace tacipc {

std::vector<std::array<int, 2>> boundary_edges(const Triangles& triangles) {
  std::map<std::pair<int, int>, int> uses;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(triangles(f, k), triangles(f, (k + 1) % 3))];
  }
  std::vector<std::array<int, 2>> edges;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      if (uses[std::minmax(a, b)] == 1) edges.push_back({a, b});
    }
  }
  return edges;
}

Membrane make_membrane(Positions positions, Positions rest, Triangles triangles) {
  assert(positions.rows() == rest.rows());
  Membrane membrane;
  membrane.normals = vertex_normals(positions, triangles);
  membrane.outline = boundary_edges(triangles);
  membrane.positions = std::move(positions);
  membrane.rest = std::move(rest);
  membrane.triangles = std::move(triangles);
  return membrane;
}

int count_loops(const std::vector<std::array<int, 2>>& edges) {
  std::map<int, std::vector<int>> ends_from;
  for (const auto& edge : edges) ends_from[edge[0]].push_back(edge[1]);
  int loops = 0;
  for (auto& [start, ends] : ends_from) {
    while (!ends.empty()) {
      ++loops;
      int vertex = start;
      do {
        std::vector<int>& onwards = ends_from[vertex];
        if (onwards.empty()) break;
        vertex = onwards.back();
        onwards.pop_back();
      } while (vertex != start);
    }
  }
  return loops;
}

Membrane make_membrane(const TetMesh& gel, const Eigen::Ref<const Positions>& deformed) {
  assert(deformed.rows() == gel.positions.rows());
  Triangles triangles = gel.surface(BoundaryTag::front);
  if (triangles.rows() == 0) throw DataError("the gel has no triangle tagged as front face");
  const std::vector<int> vertices = gel.vertices(BoundaryTag::front);
  Membrane membrane =
      make_membrane(deformed(vertices, Eigen::all), gel.positions(vertices, Eigen::all), std::move(triangles));
  membrane.gel_rows = vertices;
  const int loops = count_loops(membrane.outline);
  if (loops != 1)
    throw DataError("the gel's front face has {} boundary loops; it must be one piece without holes", loops);
  return membrane;
}

void move_membrane(Membrane& membrane, const Eigen::Ref<const Positions>& deformed) {
  assert(static_cast<Eigen::Index>(membrane.gel_rows.size()) == membrane.positions.rows());
  membrane.positions = deformed(membrane.gel_rows, Eigen::all);
  membrane.normals = vertex_normals(membrane.positions, membrane.triangles);
}

}  // namespace tacipc
