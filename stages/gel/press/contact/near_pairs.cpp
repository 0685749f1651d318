#include "stages/gel/press/contact/near_pairs.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "stages/gel/press/contact/pair_pack.h"

namespace tacipc {
namespace {

constexpr std::size_t kPairsPerChunk = 4096;
// Relative margin, far above the rounding errors of the formulas below.
constexpr double kRoundingMargin = 1e-6;
// sin² of the angle between edges below which the formula for their insides is unreliable.
constexpr double kNearlyParallelSine2 = 1e-6;

TACIPC_CLONES void distances_of_pack(const double* x, const ContactPair* const* pairs, ContactPair::Kind kind,
                                     double* out) {
  const PackedPoints p = load_points(x, pairs);
  Pack s;
  if (kind == ContactPair::Kind::point_triangle) {
    s = point_triangle_gap(p).squared_length;
  } else {
    const Pack3 ea = p[1] - p[0], eb = p[3] - p[2], n = cross(ea, eb);
    const Pack none = {};
    s = dot(n, n) < kNearlyParallelSine2 * dot(ea, ea) * dot(eb, eb) ? none : edge_edge_gap(p).squared_length;
  }
  for (int l = 0; l < kLanes; ++l) out[l] = s[l];
}

}  // namespace

std::vector<double> coarse_squared_distances(std::span<const ContactPair> pairs, const Positions& x) {
  std::vector<double> out(pairs.size());
  tbb::parallel_for(std::size_t{0}, (pairs.size() + kPairsPerChunk - 1) / kPairsPerChunk, [&](std::size_t chunk) {
    const std::size_t last = std::min(pairs.size(), (chunk + 1) * kPairsPerChunk);
    for (std::size_t i = chunk * kPairsPerChunk; i < last;) {
      const PairPack pack(pairs, i, last);
      double found[kLanes];
      distances_of_pack(x.data(), pack.pairs, pack.kind(), found);
      std::copy(found, found + pack.count, out.begin() + static_cast<std::ptrdiff_t>(i));
      i += pack.count;
    }
  });
  return out;
}

std::vector<int> near_pairs(std::span<const ContactPair> pairs, const Positions& x, double s_hat) {
  const std::vector<double> found = coarse_squared_distances(pairs, x);
  std::vector<int> near;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (found[i] < (1.0 + kRoundingMargin) * s_hat) near.push_back(static_cast<int>(i));
  }
  return near;
}

double smallest_distance(std::span<const ContactPair> pairs, const Positions& x, double none) {
  const std::vector<double> found = coarse_squared_distances(pairs, x);
  double smallest = none * none;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (found[i] < (1.0 + kRoundingMargin) * smallest)
      smallest = std::min(smallest, closest_feature(pairs[i], gather(x, pairs[i])).squared_distance);
  }
  return smallest < none * none ? std::sqrt(smallest) : none;
}

}  // namespace tacipc
