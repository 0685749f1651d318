#include "common/mesh/exact_predicates.h"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tacipc {
namespace {

constexpr double kHalfUlp = std::numeric_limits<double>::epsilon() / 2;
// The forward error of the determinants below is at most 7u and 3u times the permanent (one u spare); the constant
// covers underflow.
constexpr double kOrient3dBound = 8 * kHalfUlp;
constexpr double kOrient2dBound = 4 * kHalfUlp;
constexpr double kUnderflow = 1e-290;

int sign_of(const mpz_class& value) { return sgn(value); }

/// Scales doubles by one common power of two so that all become integers; this keeps the signs of homogeneous
/// polynomials.
template <std::size_t N>
std::array<mpz_class, N> as_integers(const std::array<double, N>& values) {
  constexpr int kMantissaBits = std::numeric_limits<double>::digits;
  std::array<double, N> mantissa;
  std::array<int, N> exponent;
  int smallest = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < N; ++i) {
    mantissa[i] = std::frexp(values[i], &exponent[i]);
    if (values[i] != 0) smallest = std::min(smallest, exponent[i]);
  }
  std::array<mpz_class, N> integers;
  for (std::size_t i = 0; i < N; ++i) {
    integers[i] = std::ldexp(mantissa[i], kMantissaBits);
    if (values[i] != 0) integers[i] <<= static_cast<mp_bitcnt_t>(exponent[i] - smallest);
  }
  return integers;
}

int orient3d_exact(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const auto z = as_integers<12>({a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), c.x(), c.y(), c.z(), d.x(), d.y(), d.z()});
  const mpz_class bx = z[3] - z[0], by = z[4] - z[1], bz = z[5] - z[2];
  const mpz_class cx = z[6] - z[0], cy = z[7] - z[1], cz = z[8] - z[2];
  const mpz_class dx = z[9] - z[0], dy = z[10] - z[1], dz = z[11] - z[2];
  return sign_of(bx * (cy * dz - cz * dy) + by * (cz * dx - cx * dz) + bz * (cx * dy - cy * dx));
}

/// Indices of the two coordinates that remain if one is dropped.
struct Projection {
  int i, j;
};
constexpr std::array<Projection, 3> kProjections{{{1, 2}, {2, 0}, {0, 1}}};

/// Returns the sign of twice the signed area of abc in the projection.
int orient2d(const Projection& on, const Vector3& a, const Vector3& b, const Vector3& c) {
  const double b_i = b[on.i] - a[on.i], b_j = b[on.j] - a[on.j];
  const double c_i = c[on.i] - a[on.i], c_j = c[on.j] - a[on.j];
  // A difference of doubles is zero only if they are equal: lines along an axis need no long integers.
  if ((b_i == 0 || c_j == 0) && (b_j == 0 || c_i == 0)) return 0;
  const double left = b_i * c_j;
  const double right = b_j * c_i;
  const double bound = kOrient2dBound * (std::abs(left) + std::abs(right)) + kUnderflow;
  const double det = left - right;
  if (det > bound) return 1;
  if (det < -bound) return -1;
  const auto z = as_integers<6>({a[on.i], a[on.j], b[on.i], b[on.j], c[on.i], c[on.j]});
  return sign_of((z[2] - z[0]) * (z[5] - z[1]) - (z[3] - z[1]) * (z[4] - z[0]));
}

bool boxes_overlap(const Vector3& p, const Vector3& q, const Vector3& a, const Vector3& b) {
  for (int i = 0; i < 3; ++i)
    if (std::max(p[i], q[i]) < std::min(a[i], b[i]) || std::max(a[i], b[i]) < std::min(p[i], q[i])) return false;
  return true;
}

/// Returns whether closed segments pq and ab of one plane intersect.
/// \param on projection that does not collapse the plane, or the common line
bool coplanar_segments_intersect(const Projection& on, const Vector3& p, const Vector3& q, const Vector3& a,
                                 const Vector3& b) {
  if (!boxes_overlap(p, q, a, b)) return false;
  if (orient2d(on, p, q, a) * orient2d(on, p, q, b) > 0) return false;
  return orient2d(on, a, b, p) * orient2d(on, a, b, q) <= 0;
}

bool segments_intersect(const Vector3& p, const Vector3& q, const Vector3& a, const Vector3& b) {
  if (!boxes_overlap(p, q, a, b)) return false;
  if (orient3d(p, q, a, b) != 0) return false;
  for (const Projection& on : kProjections)
    if (orient2d(on, p, q, a) != 0 || orient2d(on, p, q, b) != 0 || orient2d(on, a, b, p) != 0 ||
        orient2d(on, a, b, q) != 0)
      return coplanar_segments_intersect(on, p, q, a, b);
  return true;  // all four points are on one line, where overlapping boxes mean overlapping segments
}

/// Handles a segment in the plane of the triangle, and a triangle that is degenerate to a segment.
bool coplanar_segment_intersects_triangle(const Vector3& p, const Vector3& q, const TrianglePoints& t) {
  for (const Projection& on : kProjections) {
    const int turn = orient2d(on, t[0], t[1], t[2]);
    if (turn == 0) continue;
    const auto inside = [&](const Vector3& point) {
      return orient2d(on, t[0], t[1], point) * turn >= 0 && orient2d(on, t[1], t[2], point) * turn >= 0 &&
             orient2d(on, t[2], t[0], point) * turn >= 0;
    };
    return inside(p) || inside(q) || coplanar_segments_intersect(on, p, q, t[0], t[1]) ||
           coplanar_segments_intersect(on, p, q, t[1], t[2]) || coplanar_segments_intersect(on, p, q, t[2], t[0]);
  }
  return segments_intersect(p, q, t[0], t[1]) || segments_intersect(p, q, t[1], t[2]) ||
         segments_intersect(p, q, t[2], t[0]);
}

bool strictly_on_one_side(const TrianglePoints& plane, const TrianglePoints& points) {
  const int side = orient3d(plane[0], plane[1], plane[2], points[0]);
  return side != 0 && orient3d(plane[0], plane[1], plane[2], points[1]) == side &&
         orient3d(plane[0], plane[1], plane[2], points[2]) == side;
}

}  // namespace

int orient3d(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  const Vector3 u = b - a;
  const Vector3 v = c - a;
  const Vector3 w = d - a;
  // A coordinate that all four points share makes them coplanar: the usual case on a flat face, decided without long
  // integers.
  for (int i = 0; i < 3; ++i)
    if (u[i] == 0 && v[i] == 0 && w[i] == 0) return 0;
  const double vw_yz = v.y() * w.z(), wv_yz = v.z() * w.y();
  const double vw_zx = v.z() * w.x(), wv_zx = v.x() * w.z();
  const double vw_xy = v.x() * w.y(), wv_xy = v.y() * w.x();
  const double det = u.x() * (vw_yz - wv_yz) + u.y() * (vw_zx - wv_zx) + u.z() * (vw_xy - wv_xy);
  const double permanent = std::abs(u.x()) * (std::abs(vw_yz) + std::abs(wv_yz)) +
                           std::abs(u.y()) * (std::abs(vw_zx) + std::abs(wv_zx)) +
                           std::abs(u.z()) * (std::abs(vw_xy) + std::abs(wv_xy));
  // The largest length bounds the error from underflow of a product.
  const double bound = kOrient3dBound * permanent + kUnderflow * (1 + u.lpNorm<1>());
  if (det > bound) return 1;
  if (det < -bound) return -1;
  return orient3d_exact(a, b, c, d);
}

bool segment_intersects_triangle(const Vector3& p, const Vector3& q, const TrianglePoints& t) {
  // Most triangles are separated along an axis, which comparisons decide exactly.
  for (int i = 0; i < 3; ++i) {
    if (std::max(p[i], q[i]) < std::min({t[0][i], t[1][i], t[2][i]}) ||
        std::min(p[i], q[i]) > std::max({t[0][i], t[1][i], t[2][i]}))
      return false;
  }
  const int side_p = orient3d(t[0], t[1], t[2], p);
  const int side_q = orient3d(t[0], t[1], t[2], q);
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) return coplanar_segment_intersects_triangle(p, q, t);
  // The line meets the plane in one point of the segment; the point is in the triangle if the line passes all edges on
  // one side.
  const std::array<int, 3> turns{orient3d(p, q, t[0], t[1]), orient3d(p, q, t[1], t[2]), orient3d(p, q, t[2], t[0])};
  const auto [low, high] = std::ranges::minmax_element(turns);
  return *low * *high >= 0;
}

bool triangles_intersect(const TrianglePoints& first, const TrianglePoints& second) {
  if (strictly_on_one_side(first, second) || strictly_on_one_side(second, first)) return false;
  for (int i = 0; i < 3; ++i) {
    if (segment_intersects_triangle(first[i], first[(i + 1) % 3], second)) return true;
    if (segment_intersects_triangle(second[i], second[(i + 1) % 3], first)) return true;
  }
  return false;
}

bool hinge_is_folded_flat(const Vector3& v, const Vector3& w, const Vector3& a, const Vector3& b) {
  if (orient3d(v, w, a, b) != 0) return false;
  for (const Projection& on : kProjections) {
    const int side_a = orient2d(on, v, w, a);
    const int side_b = orient2d(on, v, w, b);
    if (side_a != 0 || side_b != 0) return side_a * side_b > 0;
  }
  return false;
}

bool mesh_triangles_intersect(std::array<int, 3> first, TrianglePoints p, std::array<int, 3> second, TrianglePoints q) {
  // Move common vertices to the front, in the same order for both triangles.
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = shared; j < 3; ++j)
      if (first[i] == second[j]) {
        std::swap(first[i], first[shared]);
        std::swap(p[i], p[shared]);
        std::swap(second[j], second[shared]);
        std::swap(q[j], q[shared]);
        ++shared;
        break;
      }
  switch (shared) {
    case 0: return triangles_intersect(p, q);
    // Any further common point of two triangles with one common vertex implies a point on the opposite edge of one of
    // them.
    case 1: return segment_intersects_triangle(p[1], p[2], q) || segment_intersects_triangle(q[1], q[2], p);
    case 2: return hinge_is_folded_flat(p[0], p[1], p[2], q[2]);
    default: return true;
  }
}

}  // namespace tacipc
