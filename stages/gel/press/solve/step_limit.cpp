#include "stages/gel/press/solve/step_limit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/base/error.h"
#include "stages/gel/press/contact/ccd.h"
#include "stages/gel/press/contact/near_pairs.h"
#include "stages/gel/press/contact/pair_pack.h"
#include "stages/gel/press/contact/plane_filter.h"

namespace tacipc {
namespace {

constexpr std::size_t kLimitsPerChunk = 512, kChunksPerRound = 16;
constexpr double kSmallestStep = 1e-12;

/// Computes the Bernstein coefficients of Σ c_k tᵏ on [0, t], except the first, which is c₀.
TACIPC_INLINE void find_bernstein(const auto* c, double t, auto* out) {
  out[0] = c[0] + t * c[1] / 3.0;
  out[1] = c[0] + t * (2.0 * c[1] + t * c[2]) / 3.0;
  out[2] = c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

constexpr double kVolumeFloor = 0.1, kShorter = 0.75;

/// Minimum over up to eight tetrahedra of the first t = `until`, kShorter `until`, … that leaves kVolumeFloor of the
/// volume.
TACIPC_CLONES double volume_limit(const double* x, const double* p, const int* tets, int count, double until) {
  std::array<std::array<int, kLanes>, 4> corners;
  for (int k = 0; k < 4; ++k) {
    for (int l = 0; l < kLanes; ++l) corners[k][l] = tets[4 * (l < count ? l : 0) + k];
  }
  // det[A + t B] = Σ c_k tᵏ for the edge vectors A and their change B.
  const Pack3 x0 = load_rows(x, corners[0]), p0 = load_rows(p, corners[0]);
  Pack3 A[3], B[3];
  for (int k = 0; k < 3; ++k) {
    A[k] = load_rows(x, corners[k + 1]) - x0;
    B[k] = load_rows(p, corners[k + 1]) - p0;
  }
  const Pack3 AA = cross(A[1], A[2]), BB = cross(B[1], B[2]), AB = cross(A[1], B[2]) + cross(B[1], A[2]);
  const Pack c[4] = {dot(A[0], AA), dot(B[0], AA) + dot(A[0], AB), dot(A[0], BB) + dot(B[0], AB), dot(B[0], BB)};
  // As in cubic_stays_above(). If any coefficient is NaN, so is the last.
  Pack b[3];
  find_bernstein(c, until, b);
  const Pack least = smaller(b[2], smaller(b[1], smaller(b[0], c[0]))) - kVolumeFloor * c[0];
  if (all_of(least > Pack{})) return until;
  double t = until;
  for (int l = 0; l < count; ++l) {
    const double of_one[4] = {c[0][l], c[1][l], c[2][l], c[3][l]};
    while (t > kSmallestStep && !cubic_stays_above(of_one, t, kVolumeFloor * of_one[0])) t *= kShorter;
  }
  return t;
}

/// Fraction of p, at most `until`, that one pair allows.
double pair_limit(const ContactPair& pair, const Positions& x, const Positions& p, double until, const GapRule& rule) {
  const FourPoints now = gather(x, pair);
  FourPoints d = gather(p, pair);
  for (Vector3& displacement : d) displacement *= until;
  const double distance = std::sqrt(closest_feature(pair, now).squared_distance);
  if (distance == 0.0) return 0.0;
  const double floor = std::min({rule.floor_m, 0.999 * distance, rule.near_m});
  const double slack = (floor + rule.slack * (std::min(distance, rule.near_m) - floor)) / distance;
  return until * time_of_impact(pair.kind, now, d, slack);
}

}  // namespace

double contact_step_limit(const std::vector<ContactPair>& pairs, const Positions& x, const Positions& p,
                          const GapRule& rule) {
  const Pack floor = Pack{} + rule.floor_m, near = Pack{} + rule.near_m;
  const auto limit_of = [&](std::size_t first, std::size_t last, double limit) {
    for (std::size_t i = first; i < last;) {
      const PairPack pack(pairs, i, last);
      const unsigned apart = stay_apart(x.data(), p.data(), limit, pack.pairs, pack.kind(), rule.slack, floor, near);
      for (int l = 0; l < pack.count; ++l) {
        if (!(apart >> l & 1U)) limit = pair_limit(*pack.pairs[l], x, p, limit, rule);
      }
      i += pack.count;
    }
    return limit;
  };
  // Each round of chunks checks p only up to the limit of the rounds before it, which does not depend on the number of
  // threads.
  double limit = 1.0;
  for (std::size_t round = 0; round < pairs.size() && limit > 0.0; round += kChunksPerRound * kLimitsPerChunk) {
    const std::size_t chunks =
        std::min(kChunksPerRound, (pairs.size() - round + kLimitsPerChunk - 1) / kLimitsPerChunk);
    std::vector<double> limits(chunks, limit);
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
      const std::size_t first = round + chunk * kLimitsPerChunk;
      limits[chunk] = limit_of(first, std::min(pairs.size(), first + kLimitsPerChunk), limit);
    });
    limit = *std::min_element(limits.begin(), limits.end());
  }
  if (limit <= 0.0) {
    throw SolverError("a contact pair is too close to certify any step (smallest distance {:.3g} m)",
                      smallest_distance(pairs, x, 1.0));
  }
  return limit;
}

std::vector<ContactPair> limiting_pairs(const std::vector<ContactPair>& pairs, const Positions& x, const Positions& p,
                                        const GapRule& rule) {
  const Pack floor = Pack{} + rule.floor_m, near = Pack{} + rule.near_m;
  std::vector<std::vector<ContactPair>> found((pairs.size() + kLimitsPerChunk - 1) / kLimitsPerChunk);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t chunk) {
    const std::size_t last = std::min(pairs.size(), (chunk + 1) * kLimitsPerChunk);
    for (std::size_t i = chunk * kLimitsPerChunk; i < last;) {
      const PairPack pack(pairs, i, last);
      const unsigned apart = stay_apart(x.data(), p.data(), 1.0, pack.pairs, pack.kind(), rule.slack, floor, near);
      for (int l = 0; l < pack.count; ++l) {
        if (!(apart >> l & 1U) && pair_limit(*pack.pairs[l], x, p, 1.0, rule) < 1.0)
          found[chunk].push_back(*pack.pairs[l]);
      }
      i += pack.count;
    }
  });
  std::vector<ContactPair> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

bool cubic_stays_above(const double c[4], double t, double floor) {
  double b[3];
  find_bernstein(c, t, b);
  return c[0] > floor && b[0] > floor && b[1] > floor && b[2] > floor;  // false if any is NaN
}

double inversion_step_limit(const Tetrahedra& tets, const Positions& x, const Positions& p) {
  const auto count = static_cast<std::size_t>(tets.rows());
  // A pair that allows a step allows all shorter ones, so that neither order nor chunks matter.
  std::vector<double> limits((count + kLimitsPerChunk - 1) / kLimitsPerChunk, 1.0);
  tbb::parallel_for(std::size_t{0}, limits.size(), [&](std::size_t chunk) {
    const std::size_t last = std::min(count, (chunk + 1) * kLimitsPerChunk);
    for (std::size_t i = chunk * kLimitsPerChunk; i < last; i += kLanes)
      limits[chunk] = volume_limit(x.data(), p.data(), tets.data() + 4 * i,
                                   static_cast<int>(std::min<std::size_t>(kLanes, last - i)), limits[chunk]);
  });
  const double limit = limits.empty() ? 1.0 : *std::min_element(limits.begin(), limits.end());
  if (limit <= kSmallestStep) throw SolverError("a tetrahedron is too flat to certify any step");
  return limit;
}

}  // namespace tacipc
