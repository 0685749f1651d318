// Closest features of eight pairs at a time.
#pragma once

#include "stages/gel/press/contact/pair_pack.h"

namespace tacipc {

/// ClosestFeature lane by lane, with (AᵀA)⁻¹. Entries of missing parameters are zero.
struct PackedFeature {
  Pack weights[4];
  Pack W[4][2];
  Pack3 A[2];
  Pack inverse_gram[3];  // entries 00, 01, 11
  Pack3 r;
  Pack squared_distance;
};

/// Feature of point `of` against the segment from `a` to `b`; r = sign × (point − foot).
/// \param inverse_length2 1 / squared length of the segment
TACIPC_INLINE PackedFeature segment_feature(const PackedPoints& p, int of, int a, int b, const Pack& inverse_length2,
                                            double sign) {
  PackedFeature f = {};
  const Pack3 edge = p[b] - p[a], from_a = p[of] - p[a];
  const Pack along = dot(from_a, edge), none = {}, one = none + 1.0;
  Pack u = choose(along, along * inverse_length2, none);
  u = smaller(u, one);
  const Pack within = smaller(u, one - u);
  f.weights[of] = none + sign;
  f.weights[a] = -sign * (one - u);
  f.weights[b] = -sign * u;
  f.W[a][0] = choose(within, none + sign, none);
  f.W[b][0] = choose(within, none - sign, none);
  f.A[0] = choose(within, (none - sign) * edge, Pack3{});
  f.inverse_gram[0] = choose(within, inverse_length2, none);
  f.r = (none + sign) * (from_a - u * edge);
  f.squared_distance = dot(f.r, f.r);
  return f;
}

/// Lane by lane: `yes` if the key is positive, else `no`.
TACIPC_INLINE PackedFeature choose(const Pack& key, const PackedFeature& yes, const PackedFeature& no) {
  PackedFeature f;
  for (int k = 0; k < 4; ++k) {
    f.weights[k] = choose(key, yes.weights[k], no.weights[k]);
    for (int q = 0; q < 2; ++q) f.W[k][q] = choose(key, yes.W[k][q], no.W[k][q]);
  }
  for (int q = 0; q < 2; ++q) f.A[q] = choose(key, yes.A[q], no.A[q]);
  for (int q = 0; q < 3; ++q) f.inverse_gram[q] = choose(key, yes.inverse_gram[q], no.inverse_gram[q]);
  f.r = choose(key, yes.r, no.r);
  f.squared_distance = choose(key, yes.squared_distance, no.squared_distance);
  return f;
}

/// Lane by lane the feature with the smaller distance.
TACIPC_INLINE PackedFeature nearer(const PackedFeature& a, const PackedFeature& b) {
  return choose(a.squared_distance - b.squared_distance, b, a);
}

/// Sets (AᵀA)⁻¹ of two tangents. \param inverse_n2 1 / |A₀ × A₁|²
TACIPC_INLINE void set_inverse_gram(const Pack& inverse_n2, PackedFeature& f) {
  f.inverse_gram[0] = dot(f.A[1], f.A[1]) * inverse_n2;
  f.inverse_gram[1] = -dot(f.A[0], f.A[1]) * inverse_n2;
  f.inverse_gram[2] = dot(f.A[0], f.A[0]) * inverse_n2;
}

/// Point p[0] against triangles p[1] p[2] p[3], which may have no area; unreliable for slivers.
TACIPC_INLINE PackedFeature point_triangle_feature(const PackedPoints& p) {
  const Pack3 e1 = p[2] - p[1], e2 = p[3] - p[1], w = p[0] - p[1], n = cross(e1, e2);
  const Pack none = {}, one = none + 1.0, inverse_n2 = one / dot(n, n);
  const Pack b1 = dot(cross(w, e2), n) * inverse_n2, b2 = dot(cross(e1, w), n) * inverse_n2;
  PackedFeature f = {};
  f.weights[0] = one;
  f.weights[1] = b1 + b2 - one;
  f.weights[2] = -b1;
  f.weights[3] = -b2;
  f.W[1][0] = f.W[1][1] = one;
  f.W[2][0] = f.W[3][1] = none - one;
  f.A[0] = Pack3{} - e1;
  f.A[1] = Pack3{} - e2;
  set_inverse_gram(inverse_n2, f);
  f.r = w - b1 * e1 - b2 * e2;
  f.squared_distance = dot(f.r, f.r);
  // b1 and b2 are NaN for triangles without area, which counts as not inside.
  const Pack inside = smaller(smaller(b1, b2), one - (b1 + b2));
  const Pack3 e3 = p[3] - p[2];
  const PackedFeature first = segment_feature(p, 0, 1, 2, one / dot(e1, e1), 1.0),
                      second = segment_feature(p, 0, 2, 3, one / dot(e3, e3), 1.0),
                      third = segment_feature(p, 0, 3, 1, one / dot(e2, e2), 1.0);
  return choose(inside, f, nearer(nearer(first, second), third));
}

/// Edges p[0] p[1] against p[2] p[3]; unreliable if they are parallel.
TACIPC_INLINE PackedFeature edge_edge_feature(const PackedPoints& p) {
  const Pack3 ea = p[1] - p[0], eb = p[3] - p[2], across = p[2] - p[0], n = cross(ea, eb);
  const Pack none = {}, one = none + 1.0, inverse_n2 = one / dot(n, n);
  const Pack s = dot(cross(across, eb), n) * inverse_n2, t = dot(cross(across, ea), n) * inverse_n2;
  PackedFeature f = {};
  f.weights[0] = one - s;
  f.weights[1] = s;
  f.weights[2] = t - one;
  f.weights[3] = none - t;
  f.W[1][0] = f.W[2][1] = one;
  f.W[0][0] = f.W[3][1] = none - one;
  f.A[0] = ea;
  f.A[1] = Pack3{} - eb;
  set_inverse_gram(inverse_n2, f);
  f.r = s * ea - t * eb - across;
  f.squared_distance = dot(f.r, f.r);
  const Pack inside = smaller(smaller(s, one - s), smaller(t, one - t));
  const Pack inverse_a = one / dot(ea, ea), inverse_b = one / dot(eb, eb);
  return choose(
      inside, f,
      nearer(nearer(segment_feature(p, 0, 2, 3, inverse_b, 1.0), segment_feature(p, 1, 2, 3, inverse_b, 1.0)),
             nearer(segment_feature(p, 2, 0, 1, inverse_a, -1.0), segment_feature(p, 3, 0, 1, inverse_a, -1.0))));
}

}  // namespace tacipc
