// Two primitives that may touch.
#pragma once

#include <array>
#include <cstdint>

#include "stages/gel/press/contact/distance.h"

namespace tacipc {

/// Two primitives by their four vertices: point, triangle corners; or the ends of two edges.
struct ContactPair {
  enum class Kind : std::uint8_t { point_triangle, edge_edge };
  Kind kind;
  std::array<int, 4> vertices;
  double weight = 1.0;  // of its energy (pair_counting.h)
};

inline ContactPair point_triangle_pair(int v, const std::array<int, 3>& t) {
  return {ContactPair::Kind::point_triangle, {v, t[0], t[1], t[2]}};
}

inline ContactPair edge_edge_pair(const std::array<int, 2>& e, const std::array<int, 2>& f) {
  return {ContactPair::Kind::edge_edge, {e[0], e[1], f[0], f[1]}};
}

/// The four points of a pair.
inline FourPoints gather(const Positions& x, const ContactPair& pair) {
  return {x.row(pair.vertices[0]), x.row(pair.vertices[1]), x.row(pair.vertices[2]), x.row(pair.vertices[3])};
}

/// Closest feature of a pair.
inline ClosestFeature closest_feature(const ContactPair& pair, const FourPoints& x) {
  return pair.kind == ContactPair::Kind::point_triangle ? closest_point_triangle(x) : closest_edge_edge(x);
}

}  // namespace tacipc
