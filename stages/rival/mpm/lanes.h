// Vectors of sixteen floats: one per particle, or the four numbers of four nodes above each other.
#pragma once

#include "common/base/simd.h"

namespace tacipc {

/// One number of each of sixteen particles.
using Lanes = float __attribute__((vector_size(64), aligned(64)));
using IntLanes = int __attribute__((vector_size(64), aligned(64)));
constexpr int kParticleLanes = 16;

/// Four nodes in memory, at any multiple of four floats.
using FourNodes = float __attribute__((vector_size(64), aligned(16), may_alias));
/// A quarter of sixteen lanes in memory.
using Quarter = float __attribute__((vector_size(16), aligned(16), may_alias));

TACIPC_INLINE Lanes all_lanes(float value) { return Lanes{} + value; }

TACIPC_INLINE Lanes larger(const Lanes& a, const Lanes& b) { return a > b ? a : b; }

TACIPC_INLINE float largest_of(const Lanes& a) {
  float top = a[0];
  for (int l = 1; l < kParticleLanes; ++l) top = a[l] > top ? a[l] : top;
  return top;
}

/// Repeats the four numbers of q for each of four nodes. It doubles twice, because compilers otherwise go through
/// memory.
TACIPC_INLINE Lanes on_each_node(const FloatQuad& q) {
  const auto two = __builtin_shufflevector(q, q, 0, 1, 2, 3, 4, 5, 6, 7);
  return __builtin_shufflevector(two, two, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}

/// Repeats number n of q in all four positions of node n.
TACIPC_INLINE Lanes one_per_node(const FloatQuad& q) {
  const Lanes all = on_each_node(q);
  return __builtin_shufflevector(all, all, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
}

/// Sum over the four nodes.
TACIPC_INLINE FloatQuad sum_of_nodes(const Lanes& a) {
  const FloatQuad n0 = __builtin_shufflevector(a, a, 0, 1, 2, 3), n1 = __builtin_shufflevector(a, a, 4, 5, 6, 7);
  const FloatQuad n2 = __builtin_shufflevector(a, a, 8, 9, 10, 11), n3 = __builtin_shufflevector(a, a, 12, 13, 14, 15);
  return (n0 + n1) + (n2 + n3);
}

/// Transposes the 4 × 4 matrix with the rows a, b, c, d.
TACIPC_INLINE void transpose4(FloatQuad& a, FloatQuad& b, FloatQuad& c, FloatQuad& d) {
  const FloatQuad ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                  ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const FloatQuad cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5),
                  cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// quads[l] = (r0[l], r1[l], r2[l], r3[l]).
TACIPC_INLINE void quads_of_lanes(const Lanes& r0, const Lanes& r1, const Lanes& r2, const Lanes& r3,
                                  FloatQuad* quads) {
  const Lanes* rows[4] = {&r0, &r1, &r2, &r3};
  for (int t = 0; t < 4; ++t) {
    FloatQuad part[4];
    for (int r = 0; r < 4; ++r) part[r] = reinterpret_cast<const Quarter*>(rows[r])[t];
    transpose4(part[0], part[1], part[2], part[3]);
    for (int r = 0; r < 4; ++r) quads[4 * t + r] = part[r];
  }
}

/// Inverse of quads_of_lanes: r0[l], r1[l], r2[l] from quads[l]; the fourth number is dropped.
TACIPC_INLINE void lanes_of_quads(const FloatQuad* quads, Lanes& r0, Lanes& r1, Lanes& r2) {
  Lanes* rows[3] = {&r0, &r1, &r2};
  for (int t = 0; t < 4; ++t) {
    FloatQuad part[4] = {quads[4 * t], quads[4 * t + 1], quads[4 * t + 2], quads[4 * t + 3]};
    transpose4(part[0], part[1], part[2], part[3]);
    for (int r = 0; r < 3; ++r) reinterpret_cast<Quarter*>(rows[r])[t] = part[r];
  }
}

}  // namespace tacipc
