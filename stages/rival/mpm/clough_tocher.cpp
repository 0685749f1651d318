#include "stages/rival/mpm/clough_tocher.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace tacipc {
namespace {

/// Neighbours of every point along edges, ascending.
std::vector<std::vector<int>> neighbors_of_points(Eigen::Index num_points, const Triangles& triangles) {
  std::vector<std::vector<int>> neighbors(num_points);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
      neighbors[a].push_back(b);
      neighbors[b].push_back(a);
    }
  }
  for (auto& list : neighbors) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbors;
}

/// Triangle across each edge; entry 3 t + k belongs to the edge opposite to corner k; −1 if there is none.
std::vector<Eigen::Index> triangles_across(const Triangles& triangles) {
  std::map<std::pair<int, int>, Eigen::Index> triangle_of;  // key: edge in the triangle's orientation
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) triangle_of[{triangles(t, (k + 1) % 3), triangles(t, (k + 2) % 3)}] = t;
  std::vector<Eigen::Index> across(3 * triangles.rows(), -1);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto found = triangle_of.find({triangles(t, (k + 2) % 3), triangles(t, (k + 1) % 3)});
      if (found != triangle_of.end()) across[3 * t + k] = found->second;
    }
  }
  return across;
}

}  // namespace

Points2 least_bending_gradients(const Points2& points, const Eigen::VectorXd& values, const Triangles& triangles) {
  constexpr int kMaxSweeps = 400;
  constexpr double kTolerance = 1e-6;
  const auto neighbors = neighbors_of_points(points.rows(), triangles);
  Points2 gradients = Points2::Zero(points.rows(), 2);
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double largest = 0.0;
    for (Eigen::Index p = 0; p < points.rows(); ++p) {
      if (neighbors[p].empty()) continue;
      // With e along an edge, Δ the difference in value, s₂ = g₂ · e at the far end and s₁ = g · e, ∫ w″² = 4 (s₁² + s₁
      // s₂ + s₂² − 3 Δ (s₁ + s₂) + 3 Δ²). Its derivative by g vanishes if Σ 2 e eᵀ / L³ g = Σ (3 Δ − s₂) e / L³.
      Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
      Eigen::Vector2d right = Eigen::Vector2d::Zero();
      for (const int other : neighbors[p]) {
        const Eigen::Vector2d e = (points.row(other) - points.row(p)).transpose();
        const double cubed = std::pow(e.norm(), 3);
        matrix += 2.0 / cubed * e * e.transpose();
        right += (3.0 * (values[other] - values[p]) - gradients.row(other).dot(e)) / cubed * e;
      }
      const Eigen::Vector2d gradient = matrix.inverse() * right;
      const double change = (gradient.transpose() - gradients.row(p)).cwiseAbs().maxCoeff();
      largest = std::max(largest, change / std::max(1.0, gradient.cwiseAbs().maxCoeff()));
      gradients.row(p) = gradient.transpose();
    }
    if (largest < kTolerance) break;
  }
  return gradients;
}

CloughTocher::CloughTocher(const Points2& points, const Eigen::VectorXd& values, const Triangles& triangles)
    : points_(points), triangles_(triangles), parts_(static_cast<std::size_t>(3 * triangles.rows())) {
  const Points2 gradients = least_bending_gradients(points, values, triangles);
  const auto across = triangles_across(triangles);
  const auto centroid = [&](Eigen::Index t) -> Eigen::Vector2d {
    return (corner(t, 0) + corner(t, 1) + corner(t, 2)) / 3.0;
  };
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    Part* const parts = &parts_[3 * t];
    const Eigen::Vector2d center = centroid(t);
    // At a third of the edge from a corner the control value is that of the corner's tangent plane.
    const auto towards = [&](int from, const Eigen::Vector2d& to) {
      const int vertex = triangles(t, from);
      return values[vertex] + gradients.row(vertex).dot(to - corner(t, from)) / 3.0;
    };
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      Part& part = parts[k];
      part.iii = values[triangles(t, i)];
      part.jjj = values[triangles(t, j)];
      part.iij = towards(i, corner(t, j));
      part.ijj = towards(j, corner(t, i));
      part.iic = towards(i, center);
      part.jjc = towards(j, center);
      // The derivative along one direction is made linear along the edge. Both triangles of an edge use the line
      // through their centroids (at the rim: from the edge's middle to the centroid), so that the gradient does not
      // jump. The direction is d_i V_i + d_j V_j + d_c V_c, sum 0; V_k = 3 V_c − V_i − V_j.
      double d_i = -0.5, d_j = -0.5, d_c = 1.0;
      if (const Eigen::Index other = across[3 * t + k]; other >= 0) {
        const Vector3 at = barycentric(t, centroid(other));
        d_i = at[i] - at[k];
        d_j = at[j] - at[k];
        d_c = 3.0 * at[k] - 1.0;
      }
      // The derivative's quadratic along the edge has the coefficients q_ii, q_ij, q_jj; it is linear if 2 q_ij = q_ii
      // + q_jj.
      const double ends = d_i * (part.iii + part.ijj) + d_j * (part.iij + part.jjj) + d_c * (part.iic + part.jjc);
      part.ijc = (0.5 * ends - d_i * part.iij - d_j * part.ijj) / d_c;
    }
    // Around the centroid, every control value lies in the plane of its neighbours in its two parts.
    double by_corner[3];
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      by_corner[k] = (parts[i].ijc + parts[j].ijc + parts[j].iic) / 3.0;
    }
    for (int k = 0; k < 3; ++k) {
      parts[k].icc = by_corner[(k + 1) % 3];
      parts[k].jcc = by_corner[(k + 2) % 3];
      parts[k].ccc = (by_corner[0] + by_corner[1] + by_corner[2]) / 3.0;
    }
  }
}

Vector3 CloughTocher::barycentric(Eigen::Index triangle, const Eigen::Vector2d& point) const {
  const Eigen::Vector2d a = corner(triangle, 0), ab = corner(triangle, 1) - a, ac = corner(triangle, 2) - a,
                        ap = point - a;
  const double area = ab.x() * ac.y() - ab.y() * ac.x();
  const double b = (ap.x() * ac.y() - ap.y() * ac.x()) / area, c = (ab.x() * ap.y() - ab.y() * ap.x()) / area;
  return {1.0 - b - c, b, c};
}

double CloughTocher::value(Eigen::Index triangle, const Vector3& barycentric) const {
  int k = 0;
  barycentric.minCoeff(&k);
  const Part& part = parts_[3 * triangle + k];
  const double i = barycentric[(k + 1) % 3] - barycentric[k], j = barycentric[(k + 2) % 3] - barycentric[k],
               c = 3.0 * barycentric[k];
  return i * i * (i * part.iii + 3.0 * (j * part.iij + c * part.iic)) +
         j * j * (j * part.jjj + 3.0 * (i * part.ijj + c * part.jjc)) +
         c * c * (c * part.ccc + 3.0 * (i * part.icc + j * part.jcc)) + 6.0 * i * j * c * part.ijc;
}

}  // namespace tacipc
