#include "stages/gel/tetmesh/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tacipc {

std::vector<Panel> panels(const GelShape& gel) {
  if (gel.outline == GelShape::Outline::disc) {
    const double radius = gel.radius_m, turn = 2.0 * std::numbers::pi;
    return {{.at = [=](double t) { return Vector2(radius * std::cos(turn * t), radius * std::sin(turn * t)); },
             .length_m = turn * radius,
             .min_edges = 12}};
  }
  const double x = gel.width_m / 2.0, y = gel.height_m / 2.0;
  const std::array<Vector2, 4> corners{Vector2(-x, -y), Vector2(x, -y), Vector2(x, y), Vector2(-x, y)};
  std::vector<Panel> sides;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2 from = corners[i], to = corners[(i + 1) % 4];
    // Along a side one coordinate is constant, bit by bit.
    sides.push_back({.at =
                         [=](double t) {
                           return Vector2(from.x() == to.x() ? from.x() : from.x() + (to.x() - from.x()) * t,
                                          from.y() == to.y() ? from.y() : from.y() + (to.y() - from.y()) * t);
                         },
                     .length_m = (to - from).norm()});
  }
  return sides;
}

double distance_inside(const GelShape& gel, const Vector2& point) {
  if (gel.outline == GelShape::Outline::disc) return gel.radius_m - point.norm();
  return std::min(gel.width_m / 2.0 - std::abs(point.x()), gel.height_m / 2.0 - std::abs(point.y()));
}

Vector2 pulled_inside(const GelShape& gel, const Vector2& point, double margin_m) {
  if (distance_inside(gel, point) >= margin_m) return point;
  if (gel.outline == GelShape::Outline::disc) {
    return point * (std::max(0.0, gel.radius_m - margin_m) / point.norm());
  }
  const Vector2 room(std::max(0.0, gel.width_m / 2.0 - margin_m), std::max(0.0, gel.height_m / 2.0 - margin_m));
  return point.cwiseMin(room).cwiseMax(-room);
}

std::vector<double> graded_parameters(double length_m, int min_edges,
                                      const std::function<double(double)>& edge_length) {
  constexpr int kSamples = 2048;
  std::vector<double> share(kSamples + 1, 0.0);  // ∫ ds / h up to sample i
  for (int i = 0; i < kSamples; ++i) {
    share[i + 1] = share[i] + length_m / kSamples / edge_length((i + 0.5) / kSamples);
  }
  const int edges = std::max(min_edges, static_cast<int>(std::lround(share.back())));
  std::vector<double> parameters(static_cast<std::size_t>(edges) + 1);
  int sample = 0;
  for (int i = 1; i < edges; ++i) {
    const double wanted = share.back() * i / edges;
    while (share[sample + 1] < wanted) ++sample;
    parameters[i] = (sample + (wanted - share[sample]) / (share[sample + 1] - share[sample])) / kSamples;
  }
  parameters.back() = 1.0;
  return parameters;
}

}  // namespace tacipc
