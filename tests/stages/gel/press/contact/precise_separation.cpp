#include "tests/stages/gel/press/contact/precise_separation.h"

#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

__extension__ using Float128 = __float128;  // 113 bits; no product of doubles met here leaves its range

/// One bound for every rounding error below, in units of the largest possible term; the true constants are below 64.
const Float128 kFloat128Rounding = Float128(256) * Float128(0x1p-113);
constexpr int kMaxIterations = 600;
constexpr int kMaxTries = 12;
const Float128 kBeforeImpact = 0.999;

struct Vec {
  Float128 x, y, z;
};
Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator*(Float128 s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
Float128 dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec cross(const Vec& a, const Vec& b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Float128 abs(Float128 a) { return a < 0 ? -a : a; }
/// Sum of the absolute coordinates: at least the length.
Float128 size(const Vec& a) { return abs(a.x) + abs(a.y) + abs(a.z); }

using Points = std::array<Vec, 4>;

struct Direction {
  Vec n;         // about a unit vector
  Float128 gap;  // smallest n·(first − second)
};

class ExactPaths {
 public:
  ExactPaths(ContactPair::Kind kind, const FourPoints& x_start, const FourPoints& x_end) : kind_(kind), size_(0) {
    for (int i = 0; i < 4; ++i) {
      start_[i] = difference(x_start[i], x_start[0]);
      end_[i] = difference(x_end[i], x_end[0]);
      size_ = std::max({size_, size(start_[i]), size(end_[i])});
    }
  }

  Points at(Float128 t) const {
    Points q;
    for (int i = 0; i < 4; ++i) q[i] = (1 - t) * start_[i] + t * end_[i];
    return q;
  }

  /// Error of n·(first − second) for a direction of length about 1.
  Float128 gap_error() const { return kFloat128Rounding * size_; }

  /// The direction with the largest gap among those of all closest features: vertices, edges, planes. For convex bodies
  /// that are apart this is the direction in which they are closest.
  Direction best_direction(const Points& q) const {
    Direction best{{0, 0, 0}, 0};
    const auto offer = [&](const Vec& r) {
      const double length = std::sqrt(static_cast<double>(dot(r, r)));
      if (!(length > 0 && std::isfinite(length))) return;
      const Vec n = (1 / Float128(length)) * r;
      const Float128 gap = smallest_gap(n, q);
      if (gap > best.gap) best = {n, gap};
    };
    // Vertex `point` against edge ab, r pointing from the second body to the first.
    const auto offer_edge = [&](int point, int a, int b, Float128 sign) {
      const Vec edge = q[b] - q[a];
      const Vec r = sign * (q[point] - q[a]);
      const Float128 length2 = dot(edge, edge);
      offer(r);
      offer(sign * (q[point] - q[b]));
      if (length2 > 0) offer(r - (dot(r, edge) / length2) * edge);
    };
    const Vec normal = area(q, q);
    offer(normal);
    offer(Float128(-1) * normal);
    if (kind_ == ContactPair::Kind::point_triangle) {
      offer_edge(0, 1, 2, 1);
      offer_edge(0, 2, 3, 1);
      offer_edge(0, 3, 1, 1);
    } else {
      offer_edge(0, 2, 3, 1);
      offer_edge(1, 2, 3, 1);
      offer_edge(2, 0, 1, -1);
      offer_edge(3, 0, 1, -1);
    }
    return best;
  }

  /// Where the gap along n, linear for each vertex pair, falls to twice its error.
  Float128 gap_exit(Float128 from, const Points& now, const Vec& n) const {
    Float128 exit = 1;
    for_each_gap(n, now, n, end_, [&](Float128 gap_now, Float128 gap_end, Float128) {
      const Float128 wanted = 2 * gap_error();
      if (gap_now <= wanted) {
        exit = from;
      } else if (gap_end <= wanted) {
        exit = std::min(exit, from + (1 - from) * ((gap_now - wanted) / (gap_now - gap_end)));
      }
    });
    return exit;
  }

  /// A plane whose normal goes from n_from to n_to separates the pair from `from` to `to` (see PairMotion).
  bool plane_separates(const Points& from, const Points& to, const Vec& n_from, const Vec& n_to) const {
    bool separated = true;
    for_each_gap(n_from, from, n_to, to, [&](Float128 first, Float128 last, Float128 middle) {
      separated = separated && first > gap_error() && last > gap_error() && middle > gap_error();
    });
    return separated;
  }

  /// The volume of the four vertices, a cubic in time, keeps its sign (see PairMotion).
  bool volume_keeps_sign(const Points& from, const Points& to) const {
    const Vec n0 = area(from, from);
    const Vec n1 = Float128(0.5) * (area(from, to) + area(to, from));
    const Vec n2 = area(to, to);
    const Vec r0 = across(from);
    const Vec r1 = across(to);
    const std::array<Float128, 4> volume{dot(r0, n0), (dot(r1, n0) + 2 * dot(r0, n1)) / 3,
                                         (dot(r0, n2) + 2 * dot(r1, n1)) / 3, dot(r1, n2)};
    const Float128 error =
        kFloat128Rounding * size_ * size_ * size_ * 8;  // the edges are differences: up to twice the size each
    return std::all_of(volume.begin(), volume.end(), [&](Float128 v) { return v > error; }) ||
           std::all_of(volume.begin(), volume.end(), [&](Float128 v) { return v < -error; });
  }

 private:
  static Vec difference(const Vector3& a, const Vector3& b) {
    return {Float128(a.x()) - Float128(b.x()), Float128(a.y()) - Float128(b.y()), Float128(a.z()) - Float128(b.z())};
  }

  Vec across(const Points& q) const { return kind_ == ContactPair::Kind::point_triangle ? q[0] - q[1] : q[0] - q[2]; }

  /// First tangent of p times second tangent of q.
  Vec area(const Points& p, const Points& q) const {
    if (kind_ == ContactPair::Kind::point_triangle) return cross(p[2] - p[1], q[3] - q[1]);
    return cross(p[1] - p[0], q[3] - q[2]);
  }

  /// Calls visit(gap at p along n, gap at q along m, their mixed mean) for all pairs of a vertex of each body.
  template <typename Visit>
  void for_each_gap(const Vec& n, const Points& p, const Vec& m, const Points& q, const Visit& visit) const {
    const int num_first = kind_ == ContactPair::Kind::point_triangle ? 1 : 2;
    for (int i = 0; i < num_first; ++i)
      for (int j = num_first; j < 4; ++j) {
        const Vec r = p[i] - p[j];
        const Vec s = q[i] - q[j];
        visit(dot(n, r), dot(m, s), Float128(0.5) * (dot(n, s) + dot(m, r)));
      }
  }

  Float128 smallest_gap(const Vec& n, const Points& q) const {
    Float128 smallest = 4 * size_;
    for_each_gap(n, q, n, q, [&](Float128 gap, Float128, Float128) { smallest = std::min(smallest, gap); });
    return smallest;
  }

  ContactPair::Kind kind_;
  Points start_, end_;  // relative to vertex 0
  Float128 size_;
};

}  // namespace

bool provably_apart(ContactPair::Kind kind, const FourPoints& x_start, const FourPoints& x_end,
                    double known_apart_until) {
  for (int i = 0; i < 4; ++i)
    if (!x_start[i].allFinite() || !x_end[i].allFinite()) return false;
  const ExactPaths paths(kind, x_start, x_end);
  Float128 t = known_apart_until;
  Points now = paths.at(t);
  Direction best = paths.best_direction(now);
  Float128 reach = 1;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Float128 exit = paths.gap_exit(t, now, best.n);
    if (exit <= t) return false;

    bool proven = false;
    Float128 to = std::min(Float128(1), t + reach);
    for (int tries = 0; !proven; ++tries) {
      // The last try is the step along the fixed plane.
      if (tries == kMaxTries || to <= exit) to = exit;
      const Points then = paths.at(to);
      const Direction next = paths.best_direction(then);
      proven = paths.plane_separates(now, then, best.n, next.n) || paths.volume_keeps_sign(now, then) ||
               paths.plane_separates(now, then, next.n, next.n);
      if (!proven && to == exit) {
        if (!paths.plane_separates(now, then, best.n, best.n)) return false;
        proven = true;
      }
      if (!proven) {
        to = t + (to - t) / 4;
        continue;
      }
      if (to == 1) return true;
      if (to <= t) return false;
      // Next aim just before the distance would vanish if it went on falling like this: impacts are met in few steps.
      const Float128 step = to - t;
      reach = 16 * step;
      if (next.gap < best.gap) reach = std::min(reach, kBeforeImpact * step * (next.gap / (best.gap - next.gap)));
      t = to;
      now = then;
      best = next;
    }
  }
  return false;
}

bool may_collide(ContactPair::Kind kind, const FourPoints& x_start, const FourPoints& x_end) {
  FourPoints displacement;
  for (int i = 0; i < 4; ++i) displacement[i] = x_end[i] - x_start[i];
  const double apart_until = time_of_impact(kind, x_start, displacement, 0.0);
  return apart_until < 1 && !provably_apart(kind, x_start, x_end, apart_until);
}

}  // namespace tacipc
