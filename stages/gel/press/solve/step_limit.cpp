#include "stages/gel/press/solve/step_limit.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
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

constexpr std::size_t kChunk = 512, kChunksPerRound = 16;
constexpr double kSmallestStep = 1e-12;

/// min over i < count of limit(i), at most 1; a minimum does not depend on order.
template <typename Limit>
double parallel_min(std::size_t count, Limit&& limit) {
  std::vector<double> partial((count + kChunk - 1) / kChunk, 1.0);
  tbb::parallel_for(std::size_t{0}, partial.size(), [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(count, (chunk + 1) * kChunk); ++i)
      partial[chunk] = std::min(partial[chunk], limit(i));
  });
  double smallest = 1.0;
  for (const double part : partial) smallest = std::min(smallest, part);
  return smallest;
}

/// det[A + t B] = Σ c_k tᵏ for the edge vectors A and their change B.
std::array<double, 4> volume_cubic(const Positions& x, const Positions& p, const auto& tet) {
  Matrix3 A, B;
  for (int k = 0; k < 3; ++k) {
    A.col(k) = x.row(tet[k + 1]) - x.row(tet[0]);
    B.col(k) = p.row(tet[k + 1]) - p.row(tet[0]);
  }
  const auto det = [](const Vector3& u, const Vector3& v, const Vector3& w) { return u.dot(v.cross(w)); };
  return {det(A.col(0), A.col(1), A.col(2)),
          det(B.col(0), A.col(1), A.col(2)) + det(A.col(0), B.col(1), A.col(2)) + det(A.col(0), A.col(1), B.col(2)),
          det(A.col(0), B.col(1), B.col(2)) + det(B.col(0), A.col(1), B.col(2)) + det(B.col(0), B.col(1), A.col(2)),
          det(B.col(0), B.col(1), B.col(2))};
}

/// The part of p, at most `until`, that one pair allows.
double pair_limit(const ContactPair& pair, const Positions& x, const Positions& p, double until, const GapRule& rule) {
  const FourPoints now = gather(x, pair);
  FourPoints d = gather(p, pair);
  for (Vector3& displacement : d) displacement *= until;
  const double distance = std::sqrt(closest_feature(pair, now).squared_distance);
  if (distance == 0.0) return 0.0;
  const double floor = std::min({rule.floor_m, 0.999 * distance, rule.near_m});
  const CcdOptions options{.slack = (floor + rule.slack * (std::min(distance, rule.near_m) - floor)) / distance};
  return until * (pair.kind == ContactPair::Kind::point_triangle ? time_of_impact_point_triangle(now, d, options)
                                                                 : time_of_impact_edge_edge(now, d, options));
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
  // Each round of chunks checks p only up to the limit of the rounds before it, which is the same with any number of
  // threads.
  double limit = 1.0;
  for (std::size_t round = 0; round < pairs.size() && limit > 0.0; round += kChunksPerRound * kChunk) {
    const std::size_t chunks = std::min(kChunksPerRound, (pairs.size() - round + kChunk - 1) / kChunk);
    std::vector<double> limits(chunks, limit);
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
      const std::size_t first = round + chunk * kChunk;
      limits[chunk] = limit_of(first, std::min(pairs.size(), first + kChunk), limit);
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
  std::vector<std::vector<ContactPair>> found((pairs.size() + kChunk - 1) / kChunk);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t chunk) {
    const std::size_t last = std::min(pairs.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < last;) {
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
  const double b1 = c[0] + t * c[1] / 3.0;
  const double b2 = c[0] + t * (2.0 * c[1] + t * c[2]) / 3.0;
  const double b3 = c[0] + t * (c[1] + t * (c[2] + t * c[3]));
  return std::min({c[0], b1, b2, b3}) > floor;
}

double inversion_step_limit(const Tetrahedra& tets, const Positions& x, const Positions& p) {
  const double limit = parallel_min(static_cast<std::size_t>(tets.rows()), [&](std::size_t i) {
    const auto c = volume_cubic(x, p, tets.row(static_cast<Eigen::Index>(i)));
    double t = 1.0;
    while (t > kSmallestStep && !cubic_stays_above(c.data(), t, 0.1 * c[0])) t *= 0.75;
    return t;
  });
  if (limit <= kSmallestStep) throw SolverError("a tetrahedron is too flat to certify any step");
  return limit;
}

}  // namespace tacipc
