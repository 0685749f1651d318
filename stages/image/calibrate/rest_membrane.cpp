#include "stages/image/calibrate/rest_membrane.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace tacipc {
namespace {

constexpr double kEdge = 0.5e-3;

/// Adds rings of equally many vertices around a central one.
void add_disc(double radius, std::vector<Eigen::Vector2d>& points, std::vector<std::array<int, 3>>& triangles) {
  constexpr int kSectors = 96;
  const int rings = std::max(2, static_cast<int>(std::ceil(radius / kEdge)));
  points.push_back(Eigen::Vector2d::Zero());
  for (int ring = 1; ring <= rings; ++ring)
    for (int j = 0; j < kSectors; ++j) {
      const double azimuth = 2.0 * std::numbers::pi * j / kSectors, r = radius * ring / rings;
      points.emplace_back(r * std::cos(azimuth), r * std::sin(azimuth));
    }
  const auto at = [&](int ring, int j) { return ring == 0 ? 0 : 1 + (ring - 1) * kSectors + j % kSectors; };
  for (int ring = 0; ring < rings; ++ring)
    for (int j = 0; j < kSectors; ++j) {
      if (ring > 0) triangles.push_back({at(ring, j), at(ring + 1, j + 1), at(ring, j + 1)});
      triangles.push_back({at(ring, j), at(ring + 1, j), at(ring + 1, j + 1)});
    }
}

void add_rectangle(double width, double height, std::vector<Eigen::Vector2d>& points,
                   std::vector<std::array<int, 3>>& triangles) {
  const int columns = std::max(2, static_cast<int>(std::ceil(width / kEdge)));
  const int rows = std::max(2, static_cast<int>(std::ceil(height / kEdge)));
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i)
      points.emplace_back(width * (static_cast<double>(i) / columns - 0.5),
                          height * (static_cast<double>(j) / rows - 0.5));
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i, b = a + columns + 1;
      triangles.push_back({a, a + 1, b + 1});
      triangles.push_back({a, b + 1, b});
    }
}

}  // namespace

Membrane rest_membrane(const GelShape& shape) {
  std::vector<Eigen::Vector2d> points;
  std::vector<std::array<int, 3>> faces;
  if (shape.outline == GelShape::Outline::disc)
    add_disc(shape.radius_m, points, faces);
  else
    add_rectangle(shape.width_m, shape.height_m, points, faces);
  Positions front(points.size(), 3);
  for (Eigen::Index i = 0; i < front.rows(); ++i) {
    const Eigen::Vector2d& p = points[i];
    front.row(i) << p.x(), p.y(), shape.front_z(p.x(), p.y());
  }
  Triangles triangles(faces.size(), 3);
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) triangles(f, k) = faces[f][k];
  Positions rest = front;
  return make_membrane(std::move(front), std::move(rest), std::move(triangles));
}

}  // namespace tacipc
