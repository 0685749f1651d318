// Approximate gaps of eight contact pairs of one kind at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "common/base/simd.h"
#include "stages/gel/press/contact/contact_pair.h"

namespace tacipc {

/// The four points of eight pairs.
using PackedPoints = std::array<Pack3, 4>;

/// Rows of `x` (#V × 3) at the vertices of eight pairs.
TACIPC_INLINE PackedPoints load_points(const double* x, const ContactPair* const* pairs) {
  PackedPoints out;
  for (int k = 0; k < 4; ++k) {
    out[k] = load_rows([&](int lane) __attribute__((always_inline)) {
      return x + 3 * static_cast<std::ptrdiff_t>(pairs[lane]->vertices[k]);
    });
  }
  return out;
}

/// Vector from the second side of each pair to the first, and its squared length.
struct PackedGap {
  Pack3 r;
  Pack squared_length;
};

/// Lane by lane: `yes` if the key is positive, else `no`.
TACIPC_INLINE PackedGap choose(const Pack& key, const PackedGap& yes, const PackedGap& no) {
  return {choose(key, yes.r, no.r), choose(key, yes.squared_length, no.squared_length)};
}

/// Lane by lane the shorter gap.
TACIPC_INLINE PackedGap nearer(const PackedGap& a, const PackedGap& b) {
  return choose(a.squared_length - b.squared_length, b, a);
}

/// Shortest vector w − u e with 0 ≤ u ≤ 1, times `sign`.
TACIPC_INLINE PackedGap to_segment(const Pack3& w, const Pack3& e, double sign) {
  const Pack along = dot(w, e), length2 = dot(e, e), none = {};
  Pack u = choose(along, along / length2, none);
  u = smaller(u, none + 1.0);
  const Pack3 r = w - u * e;
  return {(none + sign) * r, dot(r, r)};
}

/// Perpendicular (h/n²) n if `inside` is positive, else `otherwise`.
TACIPC_INLINE PackedGap perpendicular(const PackedGap& otherwise, const Pack3& n, const Pack& n2, const Pack& h,
                                      const Pack& inside) {
  const Pack scale = h / n2;
  return choose(inside, PackedGap{scale * n, h * scale}, otherwise);
}

/// Point p[0] against triangles p[1] p[2] p[3].
TACIPC_INLINE PackedGap point_triangle_gap(const PackedPoints& p) {
  const Pack3 e1 = p[2] - p[1], e2 = p[3] - p[1], w = p[0] - p[1], n = cross(e1, e2);
  const Pack n2 = dot(n, n);
  const Pack b1 = dot(cross(w, e2), n), b2 = dot(cross(e1, w), n);
  const PackedGap ends =
      nearer(nearer(to_segment(w, e1, 1.0), to_segment(w, e2, 1.0)), to_segment(p[0] - p[2], p[3] - p[2], 1.0));
  return perpendicular(ends, n, n2, dot(w, n), smaller(smaller(b1, b2), n2 - (b1 + b2)));
}

/// Edges p[0] p[1] against p[2] p[3].
TACIPC_INLINE PackedGap edge_edge_gap(const PackedPoints& p) {
  const Pack3 ea = p[1] - p[0], eb = p[3] - p[2], r = p[2] - p[0], minus_r = p[0] - p[2], n = cross(ea, eb);
  const Pack n2 = dot(n, n);
  const Pack s = dot(cross(r, eb), n), t = dot(cross(r, ea), n);
  const PackedGap ends = nearer(nearer(to_segment(minus_r, eb, 1.0), to_segment(p[1] - p[2], eb, 1.0)),
                                nearer(to_segment(r, ea, -1.0), to_segment(p[3] - p[0], ea, -1.0)));
  return perpendicular(ends, n, n2, dot(minus_r, n), smaller(smaller(s, n2 - s), smaller(t, n2 - t)));
}

/// Up to eight consecutive pairs of one kind, starting at `first`; missing ones repeat the first.
struct PairPack {
  const ContactPair* pairs[kLanes] = {};
  int count;

  PairPack(std::span<const ContactPair> all, std::size_t first, std::size_t last) : count(0) {
    while (count < kLanes && first + count < last && all[first + count].kind == all[first].kind) {
      pairs[count] = &all[first + count];
      ++count;
    }
    std::fill(pairs + count, pairs + kLanes, pairs[0]);
  }
  ContactPair::Kind kind() const { return pairs[0]->kind; }
};

}  // namespace tacipc
