#include "stages/press/solve/step_limit.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/error.h"
#include "stages/press/contact/ccd.h"
#include "stages/press/contact/pair_pack.h"

namespace tacipc {
namespace {

constexpr std::size_t kChunk = 512;
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

}  // namespace

namespace {

/// How far one pair lets all go.
double pair_limit(const ContactPair& pair, const Positions& x, const Positions& p, const GapRule& rule) {
  const FourPoints now = gather(x, pair), d = gather(p, pair);
  const double distance = std::sqrt(closest_feature(pair, now).squared_distance);
  const double floor = std::min(rule.floor_m, 0.999 * distance);
  const CcdOptions options{.slack = (floor + rule.slack * (distance - floor)) / distance};
  return pair.kind == ContactPair::Kind::point_triangle ? time_of_impact_point_triangle(now, d, options)
                                                        : time_of_impact_edge_edge(now, d, options);
}

/// Of eight pairs those (their bits) that a fixed plane keeps apart on the whole way, which most are. r joins points of
/// the two sides, so the distance is at most |r|; along r the gap of each two vertices is linear in time and smallest
/// at either end. r · (xᵢ − xⱼ) is compared with |r| × (the separation wanted + an error above all that rounding does
/// to paths of doubles and to these few products), |r| ≤ |r|₁.
TACIPC_CLONES unsigned apart_all_the_way(const double* x, const double* p, const ContactPair* const* pairs,
                                         ContactPair::Kind kind, double slack, double floor) {
  const PackedPoints now = load_points(x, pairs), way = load_points(p, pairs);
  const bool point_triangle = kind == ContactPair::Kind::point_triangle;
  const PackedGap gap = point_triangle ? point_triangle_gap(now) : edge_edge_gap(now);
  const auto absolute = [](const Pack3& v) __attribute__((always_inline)) {
    const Pack none = {};
    return Pack3{v.x < none ? -v.x : v.x, v.y < none ? -v.y : v.y, v.z < none ? -v.z : v.z};
  };
  const auto sum = [](const Pack3& v) __attribute__((always_inline)) { return v.x + v.y + v.z; };
  Pack size = {}, smallest = {};
  for (int k = 0; k < 4; ++k) size += sum(absolute(now[k])) + sum(absolute(way[k]));
  const int firsts = point_triangle ? 1 : 2;
  for (int a = 0; a < firsts; ++a) {
    for (int b = firsts; b < 4; ++b) {
      const Pack before = dot(gap.r, now[a] - now[b]), after = before + dot(gap.r, way[a] - way[b]);
      const Pack less = smaller(before, after);
      smallest = a == 0 && b == firsts ? less : smaller(smallest, less);
    }
  }
  constexpr double kRounding = 64 * 1.2e-16;
  const Pack wanted =
      slack * (1.0 + 1e-9) * gap.squared_length + (floor * (1.0 - slack) + kRounding * size) * sum(absolute(gap.r));
  unsigned apart = 0;
  for (int l = 0; l < kLanes; ++l) apart |= smallest[l] > wanted[l] ? 1U << l : 0U;
  return apart;
}

}  // namespace

double contact_step_limit(const std::vector<ContactPair>& pairs, const Positions& x, const Positions& p,
                          const GapRule& rule) {
  std::vector<double> limits((pairs.size() + kChunk - 1) / kChunk, 1.0);
  tbb::parallel_for(std::size_t{0}, limits.size(), [&](std::size_t chunk) {
    const std::size_t last = std::min(pairs.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < last;) {
      const PairPack pack(pairs, i, last);
      const unsigned apart = apart_all_the_way(x.data(), p.data(), pack.pairs, pack.kind(), rule.slack, rule.floor_m);
      for (int l = 0; l < pack.count; ++l) {
        if (!(apart >> l & 1U)) limits[chunk] = std::min(limits[chunk], pair_limit(*pack.pairs[l], x, p, rule));
      }
      i += pack.count;
    }
  });
  const double limit = limits.empty() ? 1.0 : *std::min_element(limits.begin(), limits.end());
  if (limit <= 0.0) {
    throw SolverError("a contact pair is too close to certify any step (smallest distance {:.3g} m)",
                      smallest_distance(pairs, x, 1.0));
  }
  return limit;
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
