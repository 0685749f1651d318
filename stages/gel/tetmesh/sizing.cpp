#include "stages/gel/tetmesh/sizing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/base/units.h"

namespace tacipc {
namespace {

double lerp(double from, double to, double t) { return from + (to - from) * t; }

/// Fraction of the circle of radius r about the centre that lies inside the gel. For a rectangle with half sides a and
/// b, these are the directions from acos(a / r) to asin(b / r) of a quarter.
double fraction_inside(const GelShape& gel, double r) {
  if (gel.outline == GelShape::Outline::disc) return 1.0;
  const double from = std::acos(std::min(1.0, gel.width_m / 2.0 / r)),
               to = std::asin(std::min(1.0, gel.height_m / 2.0 / r));
  return std::max(0.0, to - from) / (std::numbers::pi / 2.0);
}

/// Number of vertices on both faces and between them per unit of area at distance r from the centre.
double vertices_per_area(const Sizing& sizing, double r) {
  constexpr int kLayers = 64;
  const double front_z = sizing.gel.front_z(r, 0.0), thickness = front_z + sizing.gel.thickness_m;
  const auto h = [&](double depth) { return target_edge_length(sizing, {r, 0.0, front_z - depth}); };
  double count = 0.0;
  for (const double on_face : {h(0.0), h(thickness)}) count += 2.0 / (std::numbers::sqrt3 * on_face * on_face);
  // Half an edge below each face belongs to the face's own vertices.
  const double top = 0.5 * h(0.0), bottom = thickness - 0.5 * h(thickness);
  for (int layer = 0; layer < kLayers && bottom > top; ++layer) {
    const double step = (bottom - top) / kLayers, size = h(top + step * (layer + 0.5));
    count += step * std::numbers::sqrt2 / (size * size * size);
  }
  return count;
}

}  // namespace

SizingConfig SizingConfig::read(ConfigReader& in) {
  SizingConfig c;
  if (in.has("uniform_mm")) {
    c.centre_m = c.inner_m = c.rim_m = c.back_m = kMillimetre * in.number("uniform_mm", Range::positive());
    return c;
  }
  c.centre_m = kMillimetre * in.number("centre_mm", Range::positive());
  c.centre_radius_m = kMillimetre * in.number("centre_radius_mm", Range::non_negative());
  c.inner_m = kMillimetre * in.number("inner_mm", Range::positive());
  c.inner_radius_m = kMillimetre * in.number("inner_radius_mm", Range::positive());
  c.rim_m = kMillimetre * in.number("rim_mm", Range::positive());
  c.rim_exponent = in.number("rim_exponent", Range::between(0.5, 4.0));
  c.back_m = kMillimetre * in.number("back_mm", Range::positive());
  c.depth_exponent = in.number("depth_exponent", Range::between(0.25, 4.0));
  if (c.centre_radius_m >= c.inner_radius_m) in.fault("centre_radius_mm", "must be less than inner_radius_mm");
  return c;
}

double Sizing::reach_m() const {
  return gel.outline == GelShape::Outline::disc ? gel.radius_m : std::hypot(gel.width_m, gel.height_m) / 2.0;
}

double Sizing::front(double radius_m) const {
  const SizingConfig& c = config;
  if (radius_m <= c.centre_radius_m) return c.centre_m;
  if (radius_m <= c.inner_radius_m) {
    return lerp(c.centre_m, c.inner_m, (radius_m - c.centre_radius_m) / (c.inner_radius_m - c.centre_radius_m));
  }
  const double t = std::min(1.0, (radius_m - c.inner_radius_m) / (reach_m() - c.inner_radius_m));
  return lerp(c.inner_m, c.rim_m, std::pow(t, c.rim_exponent));
}

Sizing sizing_for(const SizingConfig& config, const GelShape& gel) {
  const Sizing sizing{config, gel};
  if (config.inner_radius_m >= sizing.reach_m()) {
    throw DataError("inner_radius_mm {:g} does not lie inside the gel, which reaches {:g} mm from its centre",
                    config.inner_radius_m / kMillimetre, sizing.reach_m() / kMillimetre);
  }
  constexpr double kThinnestRim = 0.01;  // fraction of the thickness at the apex; on a thinner rim tetrahedra are flat
  const double rim_m = gel.thickness_m + gel.front_z(sizing.reach_m(), 0.0);
  if (rim_m < kThinnestRim * gel.thickness_m) {
    throw DataError("the dome leaves {:.3g} mm of gel at the rim, less than 1 % of its thickness", rim_m / kMillimetre);
  }
  constexpr double kSteepest = std::numbers::sqrt2 / 2.0;  // sine of 45 degrees
  if (gel.dome_radius_m && gel.outline == GelShape::Outline::rectangle &&
      sizing.reach_m() > kSteepest * *gel.dome_radius_m) {
    throw DataError("the dome of radius {:g} mm is steeper than 45 degrees at the corners, {:g} mm from the centre",
                    *gel.dome_radius_m / kMillimetre, sizing.reach_m() / kMillimetre);
  }
  return sizing;
}

double target_edge_length(const Sizing& sizing, const Vector3& rest_point) {
  const double front_z = sizing.gel.front_z(rest_point.x(), rest_point.y());
  const double depth = std::clamp((front_z - rest_point.z()) / (front_z + sizing.gel.thickness_m), 0.0, 1.0);
  const double on_front = sizing.front(std::hypot(rest_point.x(), rest_point.y()));
  return lerp(on_front, sizing.config.back_m, std::pow(depth, sizing.config.depth_exponent));
}

double estimated_vertices(const Sizing& sizing) {
  const SizingConfig& c = sizing.config;
  double count = 0.0, from = 0.0;
  for (const double to : {c.centre_radius_m, c.inner_radius_m, sizing.reach_m()}) {
    constexpr int kRings = 200;
    // Beyond the inner radius lengths may grow a thousandfold; equal rings would be too coarse.
    const bool graded = from > 0.0 && from == c.inner_radius_m;
    const auto edge = [&](int ring) {
      const double t = static_cast<double>(ring) / kRings;
      return graded ? from * std::pow(to / from, t) : lerp(from, to, t);
    };
    for (int ring = 0; ring < kRings; ++ring) {
      const double step = edge(ring + 1) - edge(ring), r = edge(ring) + 0.5 * step;
      const double area = 2.0 * std::numbers::pi * r * step * fraction_inside(sizing.gel, r);
      count += area * vertices_per_area(sizing, r);
    }
    from = to;
  }
  return count;
}

}  // namespace tacipc
