// A contact pair: two primitives that may touch.
#pragma once

#include <array>
#include <cstdint>

#include "stages/gel/press/contact/distance.h"

namespace tacipc {

/// Two primitives by their four vertices: a point and the corners of a triangle, or the ends of two edges.
struct ContactPair {
  enum class Kind : std::uint8_t { point_triangle, edge_edge };
  Kind kind;
  /// Bits for a point and a piece of a flat face that acts as a whole (shape_features.h), see below; 0 for all other
  /// pairs.
  std::uint8_t shape;
  std::array<int, 4> vertices;
  double weight;  // factor on the pair's energy (pair_counting.h)

  ContactPair(Kind of_kind, const std::array<int, 4>& of, double of_weight = 1.0, std::uint8_t of_shape = 0)
      : kind(of_kind), shape(of_shape), vertices(of), weight(of_weight) {}
};

/// Bits of ContactPair::shape: kIsShape marks a piece of a flat face; the other bits mark edges and corners of the
/// triangle on the face's rim. Edge k leads from corner k to the next one.
inline constexpr std::uint8_t kIsShape = 64, kAllRim = 127;
inline constexpr std::uint8_t rim_edge(int k) { return static_cast<std::uint8_t>(1U << k); }
inline constexpr std::uint8_t rim_corner(int k) { return static_cast<std::uint8_t>(8U << k); }

/// Pair of vertex v and triangle t.
inline ContactPair point_triangle_pair(int v, const std::array<int, 3>& t) {
  return {ContactPair::Kind::point_triangle, {v, t[0], t[1], t[2]}};
}

/// Pair of edges e and f.
inline ContactPair edge_edge_pair(const std::array<int, 2>& e, const std::array<int, 2>& f) {
  return {ContactPair::Kind::edge_edge, {e[0], e[1], f[0], f[1]}};
}

/// Positions of the four points of a pair.
inline FourPoints gather(const Positions& x, const ContactPair& pair) {
  return {x.row(pair.vertices[0]), x.row(pair.vertices[1]), x.row(pair.vertices[2]), x.row(pair.vertices[3])};
}

/// Closest feature of a pair; at infinite distance if the pair does not count.
inline ClosestFeature closest_feature(const ContactPair& pair, const FourPoints& x) {
  if (pair.kind == ContactPair::Kind::edge_edge) return closest_edge_edge(x);
  return pair.shape == 0 ? closest_point_triangle(x) : closest_point_face(x, pair.shape);
}

}  // namespace tacipc
