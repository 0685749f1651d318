#include "stages/gel/press/contact/pair_motion.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tacipc {
namespace {

constexpr double kU = std::numeric_limits<double>::epsilon() / 2;
/// Bound of the error by underflow in a product of three lengths.
constexpr double kUnderflow = 1e-290;

/// Visits all pairs (vertex of the first body, vertex of the second).
template <typename Visit>
void for_each_vertex_pair(ContactPair::Kind kind, const Visit& visit) {
  if (kind == ContactPair::Kind::point_triangle) {
    visit(0, 1), visit(0, 2), visit(0, 3);
  } else {
    visit(0, 2), visit(0, 3), visit(1, 2), visit(1, 3);
  }
}

/// One vector across the pair and two along it: volume = across · (along_a × along_b).
struct EdgeFrame {
  Vector3 across, along_a, along_b;
};

EdgeFrame frame_of(ContactPair::Kind kind, const FourPoints& q) {
  if (kind == ContactPair::Kind::point_triangle) return {q[0] - q[1], q[2] - q[1], q[3] - q[1]};
  return {q[0] - q[2], q[1] - q[0], q[3] - q[2]};
}

}  // namespace

PairMotion::PairMotion(ContactPair::Kind kind, const FourPoints& x, const FourPoints& displacement) : kind_(kind) {
  double relative_size = 0;  // bound S
  double size = 0;           // bound M
  for (int i = 0; i < 4; ++i) {
    start_[i] = x[i] - x[0];
    change_[i] = displacement[i] - displacement[0];
    relative_size = std::max(relative_size, (start_[i].cwiseAbs() + change_[i].cwiseAbs()).maxCoeff());
    size = std::max(size, (x[i].cwiseAbs() + displacement[i].cwiseAbs()).maxCoeff());
  }
  // n·r: √3 (8 u S + 8 u M) from r, and 3 u |n| |r| ≤ 3 u √3 2 S from the product; each constant rounded up.
  gap_error_ = kU * (32 * relative_size + 16 * size) + kUnderflow;
  difference_error_ = kU * 16 * (relative_size + size) + kUnderflow;
}

FourPoints PairMotion::at(double t) const {
  FourPoints q;
  for (int i = 0; i < 4; ++i) q[i] = start_[i] + t * change_[i];
  return q;
}

ClosestFeature PairMotion::closest(double t) const {
  return kind_ == ContactPair::Kind::point_triangle ? closest_point_triangle(at(t)) : closest_edge_edge(at(t));
}

std::optional<Vector3> PairMotion::direction(const ClosestFeature& feature) const {
  Vector3 n = feature.r;
  if (feature.k == 1) {
    const Vector3 tangent = feature.A.col(0);
    n -= tangent * (tangent.dot(n) / tangent.squaredNorm());
  } else if (feature.k == 2) {
    // If r is little more than its own rounding error, the normal of the two tangents is the better direction.
    const Vector3 a = feature.A.col(0);
    const Vector3 b = feature.A.col(1);
    const Vector3 normal = a.cross(b);
    const double sine = normal.norm() / (a.norm() * b.norm());
    if (feature.r.norm() < sine * (a.norm() + b.norm())) n = normal.dot(feature.r) < 0 ? Vector3(-normal) : normal;
  }
  const double length = n.norm();
  if (!(feature.squared_distance > 0 && length > 1e-150 && length < 1e150)) return std::nullopt;
  return n / length;
}

double PairMotion::gap(double t, const Vector3& n) const {
  const FourPoints q = at(t);
  double smallest = std::numeric_limits<double>::infinity();
  for_each_vertex_pair(kind_, [&](int i, int j) { smallest = std::min(smallest, n.dot(q[i] - q[j])); });
  return smallest;
}

double PairMotion::gap_exit(double from, const Vector3& n, double separation) const {
  const FourPoints now = at(from);
  const FourPoints end = at(1);
  const double wanted = separation + 2 * gap_error_;
  double exit = 1;
  for_each_vertex_pair(kind_, [&](int i, int j) {
    const double gap_now = n.dot(now[i] - now[j]);
    const double gap_end = n.dot(end[i] - end[j]);
    if (!(gap_now > wanted)) {
      exit = from;
    } else if (!(gap_end > wanted)) {
      exit = std::min(exit, from + (1 - from) * ((gap_now - wanted) / (gap_now - gap_end)));
    }
  });
  return exit > from && plane_separates(from, exit, n, n, separation) ? exit : from;
}

bool PairMotion::plane_separates(double from, double to, const Vector3& n_from, const Vector3& n_to,
                                 double separation) const {
  const FourPoints q_from = at(from);
  const FourPoints q_to = at(to);
  // |n(t)| ≤ 1 + 8u: the normals are unit vectors up to rounding, and a chord is no longer than its ends.
  const double bound = separation * (1 + 16 * kU) + gap_error_;
  bool separated = true;
  for_each_vertex_pair(kind_, [&](int i, int j) {
    const Vector3 r_from = q_from[i] - q_from[j];
    const Vector3 r_to = q_to[i] - q_to[j];
    separated = separated && n_from.dot(r_from) > bound && n_to.dot(r_to) > bound &&
                0.5 * (n_from.dot(r_to) + n_to.dot(r_from)) > bound;
  });
  return separated;
}

bool PairMotion::volume_separates(double from, double to, double separation) const {
  const EdgeFrame f0 = frame_of(kind_, at(from));
  const EdgeFrame f1 = frame_of(kind_, at(to));
  // Bernstein coefficients of the area vector N = along_a × along_b and of the volume across · N.
  const Vector3 n0 = f0.along_a.cross(f0.along_b);
  const Vector3 n1 = 0.5 * (f0.along_a.cross(f1.along_b) + f1.along_a.cross(f0.along_b));
  const Vector3 n2 = f1.along_a.cross(f1.along_b);
  const std::array<double, 4> volume{f0.across.dot(n0), (f1.across.dot(n0) + 2 * f0.across.dot(n1)) / 3,
                                     (f0.across.dot(n2) + 2 * f1.across.dot(n1)) / 3, f1.across.dot(n2)};
  const auto [low, high] = std::minmax_element(volume.begin(), volume.end());
  const double smallest = *low > 0 ? *low : -*high;

  const double r = std::max(f0.across.norm(), f1.across.norm());
  const double a = std::max(f0.along_a.norm(), f1.along_a.norm());
  const double b = std::max(f0.along_b.norm(), f1.along_b.norm());
  const double area = std::max({n0.norm(), n1.norm(), n2.norm()});
  // First order in the error of the three differences, 2 % for the higher orders, then the rounding of the products.
  const double volume_error = 1.02 * difference_error_ * (a * b + r * a + r * b) + 32 * kU * r * a * b + kUnderflow;
  const double area_error = 1.02 * difference_error_ * (a + b) + 16 * kU * a * b + kUnderflow;
  return smallest - volume_error > separation * (area + area_error);
}

}  // namespace tacipc
