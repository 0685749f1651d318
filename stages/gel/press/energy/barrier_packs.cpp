// ContactBarrier's value and derivatives for eight pairs at a time.
#include "stages/gel/press/contact/edge_edge_mollifier.h"
#include "stages/gel/press/contact/packed_feature.h"
#include "stages/gel/press/energy/barrier.h"
#include "stages/gel/press/energy/contact_barrier.h"

namespace tacipc {
namespace {

// sin² of the angle between two edges below which distance.cpp computes the closest feature.
constexpr double kTrustedSine2 = 2e-6;

/// Bits of the lanes that evaluate_barrier() must not decide: closest features of slivers and of nearly parallel edges,
/// and mollified edges.
template <bool point_triangle>
TACIPC_INLINE unsigned doubtful_lanes(const PackedPoints& p, const double* rest, const ContactPair* const* pairs) {
  const Pack3 a = point_triangle ? p[2] - p[1] : p[1] - p[0], b = point_triangle ? p[3] - p[1] : p[3] - p[2];
  const Pack3 n = cross(a, b);
  const Pack n2 = dot(n, n);
  Pack least = kTrustedSine2 * dot(a, a) * dot(b, b);
  if (!point_triangle) {
    const PackedPoints before = load_points(rest, pairs);
    const Pack3 ra = before[1] - before[0], rb = before[3] - before[2];
    const Pack threshold = kMollifiedSine2 * dot(ra, ra) * dot(rb, rb);
    least = choose(threshold - least, threshold, least);
  }
  unsigned lanes = 0;
  for (int l = 0; l < kLanes; ++l) {
    // A triangle without area is an edge or a point that pair_counting.h made, which is reliable.
    const bool fine = n2[l] >= least[l] || (point_triangle && n2[l] == 0.0);
    lanes |= fine ? 0U : 1U << l;
  }
  return lanes;
}

/// evaluate_blended() lane by lane. The wanted vertices are template arguments, so that the compiler omits the others.
/// \return doubtful_lanes()
template <bool point_triangle, int first, int count>
TACIPC_INLINE unsigned evaluate_barrier(const double* x, const double* rest, const ContactPair* const* pairs,
                                        double s_hat, const Pack& blend, PackedBlocks& out) {
  const PackedPoints p = load_points(x, pairs);
  const PackedFeature f = point_triangle ? point_triangle_feature(p) : edge_edge_feature(p);
  const Pack s = f.squared_distance, none = {}, one = none + 1.0;
  Pack weight;
  for (int l = 0; l < kLanes; ++l) weight[l] = pairs[l]->weight;
  // Derivatives b′ and b″ as in barrier.h.
  const Pack gap = s_hat - s, inverse_s = one / s, log_ratio = logarithm(s / s_hat);
  const Pack b1 = choose(gap, weight * (gap * (2.0 * log_ratio - gap * inverse_s)), none);
  const Pack b2 = choose(gap, weight * (-2.0 * log_ratio + gap * (3.0 * s + s_hat) * inverse_s * inverse_s), none);
  // A pair of negative weight has no PSD approximation: it contributes only the exact Hessian's share.
  const Pack psd = choose(weight, blend, none), exact = one - psd;
  const Pack all = choose(weight, one, one - blend);

  // Hessian as in blended_hessian() of contact_barrier.cpp: ww and WW belong to two vertices, a_i = A (AᵀA)⁻¹ W_iᵀ to
  // one.
  const Pack along_ww = all * (psd * (4.0 * b2 + 2.0 * b1 * inverse_s) + exact * 4.0 * b2),
             along_WW = all * (-2.0 * b1);
  const Pack scale = all * (2.0 * b1 * exact);
  const Pack3& r = f.r;
  const Pack r_by_column[3] = {r.x, r.y, r.z};
  Pack3 tangent[4];
  Pack W0[4], W1[4];  // columns of W (AᵀA)⁻¹
  for (int k = first; k < first + count; ++k) {
    W0[k] = f.inverse_gram[0] * f.W[k][0] + f.inverse_gram[1] * f.W[k][1];
    W1[k] = f.inverse_gram[1] * f.W[k][0] + f.inverse_gram[2] * f.W[k][1];
    tangent[k] = W0[k] * f.A[0] + W1[k] * f.A[1];
  }
  // I − A (AᵀA)⁻¹ Aᵀ by columns.
  const Pack3 g0 = f.inverse_gram[0] * f.A[0] + f.inverse_gram[1] * f.A[1],
              g1 = f.inverse_gram[1] * f.A[0] + f.inverse_gram[2] * f.A[1];
  Pack3 across[3] = {Pack3{} - (f.A[0].x * g0 + f.A[1].x * g1), Pack3{} - (f.A[0].y * g0 + f.A[1].y * g1),
                     Pack3{} - (f.A[0].z * g0 + f.A[1].z * g1)};
  across[0].x += 1.0;
  across[1].y += 1.0;
  across[2].z += 1.0;
  for (int b = 0; b < count; ++b) {
    const int j = first + b;
    const Pack slope = 2.0 * b1 * f.weights[j];
    for (int c = 0; c < 3; ++c) out.gradient[b][c] = choose(gap, slope * r_by_column[c], none);
    const Pack tj[3] = {tangent[j].x, tangent[j].y, tangent[j].z};
    for (int a = b; a < count; ++a) {
      const int i = first + a;
      const Pack ww = f.weights[i] * f.weights[j];
      const Pack WW = W0[i] * f.W[j][0] + W1[i] * f.W[j][1];
      const Pack along = along_ww * ww + along_WW * WW, flat = scale * ww;
      const Pack with_i = scale * f.weights[j], with_j = scale * f.weights[i];
      const Pack ti[3] = {tangent[i].x, tangent[i].y, tangent[i].z};
      Pack* block = out.blocks[block_index(a, b)];
      for (int c = 0; c < 3; ++c) {
        const Pack3 column = (along * r_by_column[c] - with_i * ti[c]) * r + flat * across[c] -
                             (with_j * r_by_column[c]) * Pack3{tj[0], tj[1], tj[2]};
        block[3 * c] = choose(gap, column.x, none);
        block[3 * c + 1] = choose(gap, column.y, none);
        block[3 * c + 2] = choose(gap, column.z, none);
      }
    }
  }
  return doubtful_lanes<point_triangle>(p, rest, pairs);
}

/// Energies lane by lane. \return doubtful_lanes()
template <bool point_triangle>
TACIPC_INLINE unsigned energy_lanes(const double* x, const double* rest, const ContactPair* const* pairs, double s_hat,
                                    double* out) {
  const PackedPoints p = load_points(x, pairs);
  const Pack s = (point_triangle ? point_triangle_feature(p) : edge_edge_feature(p)).squared_distance;
  // Energy b as in barrier.h.
  const Pack gap = s_hat - s, none = {}, energy = choose(gap, -gap * gap * logarithm(s / s_hat), none);
  for (int l = 0; l < kLanes; ++l) out[l] = pairs[l]->weight * energy[l];
  return doubtful_lanes<point_triangle>(p, rest, pairs);
}
TACIPC_CLONES unsigned point_triangle_energies(const double* x, const double* rest, const ContactPair* const* pairs,
                                               double s_hat, double* out) {
  return energy_lanes<true>(x, rest, pairs, s_hat, out);
}
TACIPC_CLONES unsigned edge_edge_energies(const double* x, const double* rest, const ContactPair* const* pairs,
                                          double s_hat, double* out) {
  return energy_lanes<false>(x, rest, pairs, s_hat, out);
}

using Lanes = unsigned(const double* x, const double* rest, const ContactPair* const* pairs, double s_hat,
                       const Pack& blend, PackedBlocks& out);
TACIPC_CLONES unsigned point_lanes(const double* x, const double* rest, const ContactPair* const* pairs, double s_hat,
                                   const Pack& blend, PackedBlocks& out) {
  return evaluate_barrier<true, 0, 1>(x, rest, pairs, s_hat, blend, out);
}
TACIPC_CLONES unsigned triangle_lanes(const double* x, const double* rest, const ContactPair* const* pairs,
                                      double s_hat, const Pack& blend, PackedBlocks& out) {
  return evaluate_barrier<true, 1, 3>(x, rest, pairs, s_hat, blend, out);
}
TACIPC_CLONES unsigned edge_lanes(const double* x, const double* rest, const ContactPair* const* pairs, double s_hat,
                                  const Pack& blend, PackedBlocks& out) {
  return evaluate_barrier<false, 0, 2>(x, rest, pairs, s_hat, blend, out);
}

}  // namespace

double ContactBarrier::value_of(const std::vector<int>& near, const Positions& x) const {
  return ordered_sum(static_cast<int>(near.size()), [&](int first, int last) {
    double sum = 0.0;
    while (first < last) {
      // Takes as many consecutive pairs of one kind as possible.
      std::array<const ContactPair*, kLanes> pairs;
      int count = 0;
      for (; count < kLanes && first + count < last; ++count) {
        pairs[count] = &pairs_[near[first + count]];
        if (pairs[count]->kind != pairs[0]->kind) break;
      }
      std::fill(pairs.begin() + count, pairs.end(), pairs[0]);
      double energies[kLanes];
      const auto find =
          pairs[0]->kind == ContactPair::Kind::point_triangle ? point_triangle_energies : edge_edge_energies;
      const unsigned doubtful = find(x.data(), mesh_->rest_positions.data(), pairs.data(), s_hat_, energies);
      for (int l = 0; l < count; ++l) {
        const int i = near[first + l];
        const bool alone = (doubtful >> l & 1U) || of_gel_alone(i) || !fits_packs(i);
        sum += alone ? value_of(i, gather(x, *pairs[l])) : energies[l];
      }
      first += count;
    }
    return sum;
  });
}

void ContactBarrier::evaluate_pack(const StencilPack& which, int count, const Positions& x, const Pack& blend,
                                   WantedVertices wanted, PackedBlocks& out) const {
  std::array<const ContactPair*, kLanes> pairs;
  for (int l = 0; l < kLanes; ++l) pairs[l] = &pairs_[which[l]];
  Lanes* const lanes = wanted.count == 1 ? point_lanes : wanted.count == 3 ? triangle_lanes : edge_lanes;
  const unsigned doubtful = lanes(x.data(), mesh_->rest_positions.data(), pairs.data(), s_hat_, blend, out);
  for (int l = 0; l < count; ++l) {
    if (!(doubtful >> l & 1U) && fits_packs(which[l])) continue;
    PairLocal local;
    const bool any = evaluate_blended(which[l], gather(x, *pairs[l]), blend[l], kAllPairVertices, local);
    for (int b = 0; b < wanted.count; ++b) {
      const int j = 3 * (wanted.first + b);
      for (int c = 0; c < 3; ++c) out.gradient[b][c][l] = any ? local.gradient[j + c] : 0.0;
      for (int a = b; a < wanted.count; ++a) {
        const int i = 3 * (wanted.first + a);
        for (int c = 0; c < 9; ++c)
          out.blocks[block_index(a, b)][c][l] = any ? local.hessian(i + c % 3, j + c / 3) : 0.0;
      }
    }
  }
}

}  // namespace tacipc
