#include "stages/gel/press/contact/distance.h"

#include <Eigen/Geometry>

#include <limits>
#include <optional>

namespace tacipc {
namespace {

/// Below this sine² of the angle between the two tangents, every edge candidate is also compared.
constexpr double kIllConditionedSine2 = 1e-6;
/// Tolerance in faces: a point nearer to an edge or its end than this fraction of the edge counts as on it.
constexpr double kTie = 1e-12;
/// Direction that decides ties: a point on an edge belongs to the triangle on this side. It is unlikely that an edge of
/// a file is parallel or perpendicular to it.
const Vector3 kTieSide(0.5387, 0.2913, 0.7905);
/// Below this sine² the two tangents count as parallel.
constexpr double kParallelSine2 = 1e-26;

/// Feature of vertices i (first body) and j (second body).
ClosestFeature point_point(const FourPoints& x, int i, int j) {
  ClosestFeature f{.weights = Eigen::Vector4d::Zero(),
                   .W = Eigen::Matrix<double, 4, 2>::Zero(),
                   .A = Eigen::Matrix<double, 3, 2>::Zero(),
                   .k = 0,
                   .r = x[i] - x[j],
                   .squared_distance = 0};
  f.weights[i] = 1;
  f.weights[j] = -1;
  f.squared_distance = f.r.squaredNorm();
  return f;
}

/// Nearest point of edge ab to a vertex. `sign` is +1 if the vertex belongs to the first body, −1 if the edge does.
struct EdgeFit {
  int point, a, b;
  double sign;
  double u;   // position on the edge: 0 at a, 1 at b
  Vector3 r;  // vector from the nearest point to the vertex
  double squared_distance;
};

/// \param tie a point nearer to an end than this fraction of the edge counts as at the end
EdgeFit fit_edge(const FourPoints& x, int point, int a, int b, double sign, double tie = 0.0) {
  const Vector3 edge = x[b] - x[a];
  const Vector3 from_a = x[point] - x[a], from_b = x[point] - x[b];
  const double length2 = edge.squaredNorm();
  const double along = from_a.dot(edge);
  // length2 > 0 if along > 0
  const double u = !(along > tie * length2) ? 0.0 : !(along / length2 < 1 - tie) ? 1.0 : along / length2;
  // Measured from the nearer end, with less cancellation.
  const Vector3 r = u <= 0.5 ? Vector3(from_a - u * edge) : Vector3(from_b + (1 - u) * edge);
  return {point, a, b, sign, u, r, r.squaredNorm()};
}

const EdgeFit& nearer(const EdgeFit& a, const EdgeFit& b) { return b.squared_distance < a.squared_distance ? b : a; }

ClosestFeature feature_of(const EdgeFit& fit, const FourPoints& x) {
  const auto [point, a, b, sign, u, r, squared_distance] = fit;
  if (u == 0.0 || u == 1.0) {
    const int end = u == 0.0 ? a : b;
    return sign > 0 ? point_point(x, point, end) : point_point(x, end, point);
  }
  ClosestFeature f{.weights = Eigen::Vector4d::Zero(),
                   .W = Eigen::Matrix<double, 4, 2>::Zero(),
                   .A = Eigen::Matrix<double, 3, 2>::Zero(),
                   .k = 1,
                   .r = sign * r,
                   .squared_distance = squared_distance};
  f.weights[point] = sign;
  f.weights[a] = -sign * (1 - u);
  f.weights[b] = -sign * u;
  f.W(a, 0) = sign;
  f.W(b, 0) = -sign;
  f.A.col(0) = -sign * (x[b] - x[a]);
  return f;
}

const ClosestFeature& nearer(const ClosestFeature& a, const ClosestFeature& b) {
  return b.squared_distance < a.squared_distance ? b : a;
}

struct PlaneFit {
  double p, q;
  double sine2;  // sine² of the angle between the tangents
};

/// Minimises |r + p a + q b|. Uses Gram–Schmidt on the longer tangent: with an angle θ the error grows like ε/θ, not
/// ε/θ².
/// \return nothing if a and b are parallel
std::optional<PlaneFit> minimise_over_plane(const Vector3& r, const Vector3& a, const Vector3& b) {
  const double aa = a.squaredNorm();
  const double bb = b.squaredNorm();
  const double sine2 = a.cross(b).squaredNorm() / (aa * bb);
  if (!(sine2 > kParallelSine2)) return std::nullopt;  // also true for a zero length (0/0)
  const bool swapped = bb > aa;
  const Vector3& first = swapped ? b : a;
  const Vector3& second = swapped ? a : b;
  const double first2 = swapped ? bb : aa;
  const Vector3 across = second - (second.dot(first) / first2) * first;
  const Vector3 r_across = r - (r.dot(first) / first2) * first;
  const double v = -r_across.dot(across) / across.squaredNorm();
  const double u = -(r + v * second).dot(first) / first2;
  return swapped ? PlaneFit{v, u, sine2} : PlaneFit{u, v, sine2};
}

ClosestFeature nearest_triangle_edge(const FourPoints& x, bool e12, bool e23, bool e31) {
  std::optional<EdgeFit> best;
  const auto offer = [&](int a, int b) {
    const EdgeFit fit = fit_edge(x, 0, a, b, 1);
    if (!best || fit.squared_distance < best->squared_distance) best = fit;
  };
  if (e12) offer(1, 2);
  if (e23) offer(2, 3);
  if (e31) offer(3, 1);
  return feature_of(*best, x);
}

/// Feature of point x0 above the inside of the triangle, at x1 + b1 (x2 − x1) + b2 (x3 − x1).
ClosestFeature above_triangle(const FourPoints& x, double b1, double b2) {
  const Vector3 e1 = x[2] - x[1], e2 = x[3] - x[1];
  ClosestFeature f{.weights = {1, -(1 - b1 - b2), -b1, -b2},
                   .W = Eigen::Matrix<double, 4, 2>::Zero(),
                   .A = Eigen::Matrix<double, 3, 2>::Zero(),
                   .k = 2,
                   .r = x[0] - x[1] - b1 * e1 - b2 * e2,
                   .squared_distance = 0};
  f.squared_distance = f.r.squaredNorm();
  f.W.col(0) << 0, 1, -1, 0;
  f.W.col(1) << 0, 1, 0, -1;
  f.A.col(0) = -e1;
  f.A.col(1) = -e2;
  return f;
}

}  // namespace

ClosestFeature closest_point_triangle(const FourPoints& x) {
  const Vector3 e1 = x[2] - x[1];
  const Vector3 e2 = x[3] - x[1];
  const Vector3 from_x1 = x[0] - x[1];
  const std::optional<PlaneFit> fit = minimise_over_plane(from_x1, -e1, -e2);
  if (!fit) return nearest_triangle_edge(x, true, true, true);
  const double b1 = fit->p;
  const double b2 = fit->q;
  const double b0 = 1 - b1 - b2;
  const bool inside = b0 > 0 && b1 > 0 && b2 > 0;
  const bool well_conditioned = fit->sine2 > kIllConditionedSine2;
  // A point beyond some edges is nearest to one of these.
  if (!inside && well_conditioned) return nearest_triangle_edge(x, !(b2 > 0), !(b0 > 0), !(b1 > 0));
  if (!inside) return nearest_triangle_edge(x, true, true, true);
  const ClosestFeature f = above_triangle(x, b1, b2);
  return well_conditioned ? f : nearer(f, nearest_triangle_edge(x, true, true, true));
}

ClosestFeature closest_point_face(const FourPoints& x, unsigned rim) {
  const Vector3 n = (x[2] - x[1]).cross(x[3] - x[1]);
  const auto corner = [](int k) { return 1 + k % 3; };
  const auto counted = [&](const EdgeFit& fit, int bit) {
    ClosestFeature found = feature_of(fit, x);
    if (!(rim >> bit & 1U)) found.squared_distance = std::numeric_limits<double>::infinity();
    return found;
  };
  const std::optional<PlaneFit> fit = minimise_over_plane(x[0] - x[1], x[1] - x[2], x[1] - x[3]);
  bool inside = fit.has_value();
  std::optional<EdgeFit> nearest;
  int bit = 0;
  for (int k = 0; k < 3; ++k) {
    const EdgeFit on_edge = fit_edge(x, 0, corner(k), corner(k + 1), 1, kTie);
    const bool between_ends = on_edge.u > 0.0 && on_edge.u < 1.0;
    if (fit) {
      const double b[3] = {1 - fit->p - fit->q, fit->p, fit->q};
      const Vector3 edge = x[corner(k + 1)] - x[corner(k)];
      const double tie = kTie * edge.squaredNorm() / n.norm(), across = b[(k + 2) % 3];
      // Exactly above the rim counts as inside: there the face is flat, and no force grows across the rim.
      const bool within = across > tie || (across >= -tie && ((rim >> k & 1U) || kTieSide.dot(n.cross(edge)) > 0));
      // If the point is beyond an edge, its foot on the edge is the nearest point. Distances alone could not
      // distinguish it from a nearby corner.
      if (!within && between_ends) return counted(on_edge, k);
      inside = inside && within;
    } else if (between_ends) {
      return counted(on_edge, k);
    }
    if (between_ends || (nearest && nearest->squared_distance <= on_edge.squared_distance)) continue;
    nearest = on_edge;
    bit = 3 + (on_edge.u == 0.0 ? k : (k + 1) % 3);
  }
  return inside ? above_triangle(x, fit->p, fit->q) : counted(*nearest, bit);
}

ClosestFeature closest_edge_edge(const FourPoints& x) {
  const Vector3 ea = x[1] - x[0];
  const Vector3 eb = x[3] - x[2];
  const Vector3 from_x2 = x[0] - x[2];
  const std::optional<PlaneFit> fit = minimise_over_plane(from_x2, ea, -eb);
  std::optional<ClosestFeature> inside;
  if (fit && fit->p > 0 && fit->p < 1 && fit->q > 0 && fit->q < 1) {
    const double s = fit->p;
    const double t = fit->q;
    inside = ClosestFeature{.weights = {1 - s, s, -(1 - t), -t},
                            .W = Eigen::Matrix<double, 4, 2>::Zero(),
                            .A = Eigen::Matrix<double, 3, 2>::Zero(),
                            .k = 2,
                            .r = from_x2 + s * ea - t * eb,
                            .squared_distance = 0};
    inside->squared_distance = inside->r.squaredNorm();
    inside->W.col(0) << -1, 1, 0, 0;
    inside->W.col(1) << 0, 0, 1, -1;
    inside->A.col(0) = ea;
    inside->A.col(1) = -eb;
    // The distance is convex in (s, t): a critical point inside is the minimum.
    if (fit->sine2 > kIllConditionedSine2) return *inside;
  }
  const EdgeFit ends[4] = {fit_edge(x, 0, 2, 3, 1), fit_edge(x, 1, 2, 3, 1), fit_edge(x, 2, 0, 1, -1),
                           fit_edge(x, 3, 0, 1, -1)};
  const ClosestFeature end_points = feature_of(nearer(nearer(ends[0], ends[1]), nearer(ends[2], ends[3])), x);
  return inside ? nearer(*inside, end_points) : end_points;
}

Vector12 squared_distance_gradient(const ClosestFeature& feature) {
  Vector12 gradient;
  for (int i = 0; i < 4; ++i) gradient.segment<3>(3 * i) = 2 * feature.weights[i] * feature.r;
  return gradient;
}

Eigen::Matrix2d inverse_gram(const ClosestFeature& feature) {
  Eigen::Matrix2d inverse = Eigen::Matrix2d::Zero();
  const double aa = feature.A.col(0).squaredNorm();
  if (feature.k == 1) inverse(0, 0) = 1 / aa;
  if (feature.k == 2) {
    const double bb = feature.A.col(1).squaredNorm();
    const double ab = feature.A.col(0).dot(feature.A.col(1));
    const double determinant = Vector3(feature.A.col(0)).cross(Vector3(feature.A.col(1))).squaredNorm();
    inverse << bb, -ab, -ab, aa;
    inverse /= determinant;
  }
  return inverse;
}

Matrix12 squared_distance_hessian(const ClosestFeature& feature) {
  Matrix12 hessian = Matrix12::Zero();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      hessian.block<3, 3>(3 * i, 3 * j).diagonal().setConstant(2 * feature.weights[i] * feature.weights[j]);
  if (feature.k == 0) return hessian;
  Eigen::Matrix<double, 12, 2> B;
  for (int i = 0; i < 4; ++i)
    for (int q = 0; q < 2; ++q)
      B.block<3, 1>(3 * i, q) = feature.W(i, q) * feature.r + feature.weights[i] * feature.A.col(q);
  hessian.noalias() -= 2 * B * inverse_gram(feature) * B.transpose();
  return hessian;
}

}  // namespace tacipc
