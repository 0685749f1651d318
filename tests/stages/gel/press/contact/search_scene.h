// Sets of contact pairs, and a scene small enough to look at all pairs there are.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "stages/gel/press/contact/contact_mesh.h"
#include "stages/gel/press/contact/contact_pair.h"
#include "stages/gel/press/contact/distance.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {

inline bool same(const ContactPair& a, const ContactPair& b) { return a.kind == b.kind && a.vertices == b.vertices; }
inline bool less(const ContactPair& a, const ContactPair& b) {
  return a.kind != b.kind ? a.kind < b.kind : a.vertices < b.vertices;
}

/// In one order, the two edges of a pair of gel edges either first.
inline std::vector<ContactPair> sorted(std::vector<ContactPair> pairs,
                                       int num_gel_vertices = std::numeric_limits<int>::max()) {
  for (ContactPair& pair : pairs) {
    auto& v = pair.vertices;
    if (pair.kind == ContactPair::Kind::edge_edge && v[0] < num_gel_vertices && v[2] < num_gel_vertices &&
        std::pair(v[2], v[3]) < std::pair(v[0], v[1])) {
      std::swap(v[0], v[2]);
      std::swap(v[1], v[3]);
    }
  }
  std::sort(pairs.begin(), pairs.end(), less);
  return pairs;
}

/// All pairs of two primitives of one surface without a common vertex.
inline std::vector<ContactPair> all_pairs(const Surface& gel) {
  std::vector<ContactPair> all;
  const auto apart = [](const auto& a, const auto& b) {
    return std::none_of(a.begin(), a.end(), [&](int v) { return std::find(b.begin(), b.end(), v) != b.end(); });
  };
  for (const int v : gel.vertices) {
    for (const auto& t : gel.triangles) {
      if (apart(std::array{v}, t)) all.push_back(point_triangle_pair(v, t));
    }
  }
  for (std::size_t i = 0; i < gel.edges.size(); ++i) {
    for (std::size_t j = i + 1; j < gel.edges.size(); ++j) {
      if (apart(gel.edges[i], gel.edges[j])) all.push_back(edge_edge_pair(gel.edges[i], gel.edges[j]));
    }
  }
  return all;
}

/// Those of the gel, and all of gel and object.
inline std::vector<ContactPair> all_pairs(const ContactMesh& mesh) {
  const auto& [gel, object] = std::tie(mesh.gel, mesh.object);
  std::vector<ContactPair> all = all_pairs(gel);
  for (const int v : gel.vertices) {
    for (const auto& t : object.triangles) all.push_back(point_triangle_pair(v, t));
  }
  for (const int v : object.vertices) {
    for (const auto& t : gel.triangles) all.push_back(point_triangle_pair(v, t));
  }
  for (const auto& e : gel.edges) {
    for (const auto& f : object.edges) all.push_back(edge_edge_pair(e, f));
  }
  return all;
}

/// How near a pair counts: one of the gel within half of its distance at rest at most.
inline double reach(const ContactMesh& mesh, const ContactPair& pair, double d_hat_m) {
  const auto& v = pair.vertices;
  if (std::max({v[0], v[1], v[2], v[3]}) >= mesh.num_gel_vertices) return d_hat_m;
  const double at_rest = closest_feature(pair, gather(mesh.rest_positions, pair)).squared_distance;
  return std::min(d_hat_m, 0.5 * std::sqrt(at_rest));
}

inline double nearest_on_the_way(const ContactPair& pair, const Positions& x, const Positions& p) {
  double nearest = 1.0;
  for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    FourPoints at = gather(x, pair);
    const FourPoints d = gather(p, pair);
    for (int k = 0; k < 4; ++k) at[k] += t * d[k];
    nearest = std::min(nearest, std::sqrt(closest_feature(pair, at).squared_distance));
  }
  return nearest;
}

/// A block of gel under a pyramid whose tip is in reach.
struct SearchScene {
  TetMesh gel = block_gel(6, 0.006, 0.002);
  TriangleMesh object = pyramid(0.003, 0.002);
  ContactMesh mesh;
  Positions x;
  std::mt19937 random{7};

  SearchScene() {
    object.positions.col(2).array() += 0.1e-3 - object.positions.col(2).minCoeff();
    mesh = make_contact_mesh(gel.positions, boundary_triangles(gel.tets, gel.positions.rows()), {object});
    x = mesh.rest_positions;
  }
  Positions displacement(double largest) {
    std::uniform_real_distribution<double> uniform(-largest, largest);
    Positions p(x.rows(), 3);
    for (double& c : p.reshaped()) c = uniform(random);
    return p;
  }
};

}  // namespace tacipc
