#include "stages/gel/press/contact/plane_filter.h"

#include "stages/gel/press/contact/pair_pack.h"

namespace tacipc {

// r joins points of the two sides, so the distance is at most |r|. Along r the gap of each pair of vertices is linear
// in time and smallest at either end. r · (xᵢ − xⱼ) is compared with |r| × (the wanted separation + an error above all
// rounding in paths of doubles and in these few products), |r| ≤ |r|₁.
TACIPC_CLONES unsigned stay_apart(const double* x, const double* p, double until, const ContactPair* const* pairs,
                                  ContactPair::Kind kind, double slack, const Pack& floor_m, const Pack& near_m) {
  const PackedPoints now = load_points(x, pairs);
  PackedPoints displacement = load_points(p, pairs);
  for (Pack3& d : displacement) d = (Pack{} + until) * d;
  const bool point_triangle = kind == ContactPair::Kind::point_triangle;
  const PackedGap gap = point_triangle ? point_triangle_gap(now) : edge_edge_gap(now);
  const auto absolute = [](const Pack3& v) __attribute__((always_inline)) {
    const Pack none = {};
    return Pack3{v.x < none ? -v.x : v.x, v.y < none ? -v.y : v.y, v.z < none ? -v.z : v.z};
  };
  const auto sum = [](const Pack3& v) __attribute__((always_inline)) { return v.x + v.y + v.z; };
  Pack size = {}, smallest = {};
  for (int k = 0; k < 4; ++k) size += sum(absolute(now[k])) + sum(absolute(displacement[k]));
  const int firsts = point_triangle ? 1 : 2;
  for (int a = 0; a < firsts; ++a) {
    for (int b = firsts; b < 4; ++b) {
      const Pack before = dot(gap.r, now[a] - now[b]), after = before + dot(gap.r, displacement[a] - displacement[b]);
      const Pack less = smaller(before, after);
      smallest = a == 0 && b == firsts ? less : smaller(smallest, less);
    }
  }
  constexpr double kRounding = 64 * 1.2e-16;
  // |r| ≤ (a + |r|²/a) / 2 for any a > 0; starting at |r|₁ ≤ √3 |r|, the result is at most a hundredth too large.
  Pack length_bound = sum(absolute(gap.r));
  for (int k = 0; k < 2; ++k) length_bound = (0.5 + 1e-15) * (length_bound + gap.squared_length / length_bound);
  const Pack wanted = slack * (1.0 + 1e-9) * smaller(gap.squared_length, near_m * length_bound) +
                      (floor_m * (1.0 - slack) + kRounding * size) * length_bound;
  unsigned apart = 0;
  for (int l = 0; l < kLanes; ++l) apart |= smallest[l] > wanted[l] ? 1U << l : 0U;
  return apart;
}

}  // namespace tacipc
