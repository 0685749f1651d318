#include "verification/object_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "common/base/units.h"
#include "tests/make_mesh.h"
#include "verification/shared_files.h"

namespace tacipc::verify {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

/// Surface of revolution about z from a profile (ρ, z) that starts and ends on the axis and has the outside to its
/// right. `edge_m[i]` is the target edge length around ring i.
TriangleMesh revolve(const std::vector<Vector2d>& profile, const std::vector<double>& edge_m) {
  std::vector<Vector3> points;
  std::vector<int> start, count;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const double radius = profile[i].x();
    const int n = radius <= 0.0 ? 1 : std::max(8, static_cast<int>(std::ceil(2.0 * pi * radius / edge_m[i])));
    start.push_back(static_cast<int>(points.size()));
    count.push_back(n);
    for (int k = 0; k < n; ++k) {
      // Every other ring is turned by half an edge, so that no seam runs up the surface.
      const double angle = 2.0 * pi * (k + 0.5 * static_cast<double>(i % 2)) / n;
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), profile[i].y());
    }
  }
  // Between two rings the triangles advance on the ring whose angle is smaller.
  std::vector<std::array<int, 3>> triangles;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const int n = count[i], m = count[i + 1], a0 = start[i], b0 = start[i + 1];
    int a = 0, b = 0;
    const double shift_a = 0.5 * static_cast<double>(i % 2), shift_b = 0.5 - shift_a;
    while (a < (n > 1 ? n : 0) || b < (m > 1 ? m : 0)) {
      const double next_a = n > 1 && a < n ? (a + 1 + shift_a) / n : 2.0;
      const double next_b = m > 1 && b < m ? (b + 1 + shift_b) / m : 2.0;
      if (next_a <= next_b) {
        triangles.push_back({a0 + a % n, a0 + (a + 1) % n, b0 + b % m});
        ++a;
      } else {
        triangles.push_back({a0 + a % n, b0 + (b + 1) % m, b0 + b % m});
        ++b;
      }
    }
  }
  return make_mesh(points, triangles);
}

/// Edges are `edge_m` long up to `fine_radius_m` along the meridian, then grow by a third of the distance beyond.
TriangleMesh sphere(const ObjectShape& s) {
  std::vector<Vector2d> profile{{0.0, 0.0}};
  std::vector<double> edges{s.edge_m};
  const double arc = pi * s.radius_m;
  std::vector<double> way{0.0};
  while (way.back() < arc) {
    const double edge = s.edge_m + std::max(0.0, way.back() - s.fine_radius_m) / 3.0;
    way.push_back(way.back() + std::min(edge, arc / 6.0));
  }
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double angle = way[i] / way.back() * pi;
    const bool pole = i + 1 == way.size();
    profile.emplace_back(pole ? 0.0 : s.radius_m * std::sin(angle), s.radius_m * (1.0 - std::cos(angle)));
    edges.push_back(way[i] - way[i - 1]);
  }
  return revolve(profile, edges);
}

TriangleMesh punch(const ObjectShape& s) {
  std::vector<Vector2d> profile{{0.0, 0.0}};
  const double flat = s.radius_m - s.fillet_m;
  const int rings = std::max(1, static_cast<int>(std::ceil(flat / s.edge_m)));
  for (int i = 1; i <= rings; ++i) profile.emplace_back(flat * i / rings, 0.0);
  if (s.fillet_m > 0.0) {
    const int turns = std::max(4, static_cast<int>(std::ceil(pi / 2.0 * s.fillet_m / s.edge_m)));
    for (int i = 1; i <= turns; ++i) {
      const double angle = pi / 2.0 * i / turns;
      profile.emplace_back(flat + s.fillet_m * std::sin(angle), s.fillet_m * (1.0 - std::cos(angle)));
    }
  }
  profile.emplace_back(s.radius_m, s.height_m);
  profile.emplace_back(0.0, s.height_m);
  return revolve(profile, std::vector<double>(profile.size(), s.edge_m));
}

TriangleMesh cone(const ObjectShape& s) {
  std::vector<Vector2d> profile{{0.0, 0.0}};
  const int rings = std::max(1, static_cast<int>(std::ceil(std::hypot(s.radius_m, s.height_m) / s.edge_m)));
  for (int i = 1; i <= rings; ++i) profile.emplace_back(s.radius_m * i / rings, s.height_m * i / rings);
  profile.emplace_back(0.0, s.height_m);
  return revolve(profile, std::vector<double>(profile.size(), s.edge_m));
}

TriangleMesh cylinder(const ObjectShape& s) {
  const int sides = 2 * static_cast<int>(std::ceil(pi * s.radius_m / s.edge_m));
  std::vector<Vector2d> polygon;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * pi * i / sides;
    polygon.emplace_back(s.radius_m * std::sin(angle), s.radius_m * (1.0 - std::cos(angle)));
  }
  return extrude(polygon, s.length_m);
}

}  // namespace

TriangleMesh extrude(const std::vector<Vector2d>& polygon, double length_m) {
  std::vector<Vector3> points;
  const int n = static_cast<int>(polygon.size());
  for (const double end : {-0.5, 0.5})
    for (const Vector2d& p : polygon) points.emplace_back(p.x(), length_m * end, p.y());
  std::vector<std::array<int, 3>> triangles;
  for (int a = 0; a < n; ++a) {
    const int b = (a + 1) % n;
    triangles.push_back({a, a + n, b});
    triangles.push_back({b, a + n, b + n});
  }
  for (int i = 1; i + 1 < n; ++i) {
    triangles.push_back({0, i, i + 1});
    triangles.push_back({n, n + i + 1, n + i});
  }
  return make_mesh(points, triangles);
}

ObjectShape ObjectShape::read(ConfigReader& in) {
  using Lengths = std::vector<std::pair<const char*, double ObjectShape::*>>;
  const std::pair<const char*, double ObjectShape::*> radius{"radius_mm", &ObjectShape::radius_m},
      edge{"edge_mm", &ObjectShape::edge_m}, height{"height_mm", &ObjectShape::height_m},
      length{"length_mm", &ObjectShape::length_m}, half_width{"half_width_mm", &ObjectShape::half_width_m};
  const std::vector<std::tuple<const char*, Kind, Lengths>> kinds{
      {"sphere", Kind::sphere, {radius, edge, {"fine_radius_mm", &ObjectShape::fine_radius_m}}},
      {"punch", Kind::punch, {radius, edge, height}},
      {"cone", Kind::cone, {radius, edge, height}},
      {"cylinder", Kind::cylinder, {radius, edge, length}},
      {"plate", Kind::plate, {half_width}},
      {"block", Kind::block, {half_width, {"half_depth_mm", &ObjectShape::half_depth_m}, height}},
      {"wedge", Kind::wedge, {half_width, length, height}},
      {"file", Kind::file, {}}};
  ObjectShape s;
  int given = 0;
  for (const auto& [name, kind, lengths] : kinds) {
    auto part = in.optional_section(name);
    if (!part) continue;
    ++given;
    s.kind = kind;
    for (const auto& [key, member] : lengths) s.*member = kMillimetre * part->number(key, Range::positive());
    if (kind == Kind::punch) {
      s.fillet_m = kMillimetre * part->number_or("fillet_mm", 0.0, Range::non_negative());
      if (s.fillet_m >= std::min(s.radius_m, s.height_m))
        part->fault("fillet_mm", "must be less than radius and height");
    } else if (kind == Kind::file) {
      s.path = part->text("path");
      s.unit_m = metres_per_unit(part->choice("unit", {"m", "cm", "mm", "um", "in"}));
    }
  }
  if (given != 1) in.fault("sphere", "give one of sphere, punch, cone, cylinder, plate, block, wedge, file");
  return s;
}

TriangleMesh make_object(const ObjectShape& s, const std::filesystem::path& shared) {
  using Kind = ObjectShape::Kind;
  const double w = s.half_width_m;
  switch (s.kind) {
    case Kind::sphere: return sphere(s);
    case Kind::punch: return punch(s);
    case Kind::cone: return cone(s);
    case Kind::cylinder: return cylinder(s);
    case Kind::plate: {
      // The circle of radius w inside the lower face has the centre of the bounding box; the tip leans outwards for
      // that.
      const double side = std::numbers::sqrt3 * w;
      return make_mesh({{-side, -w, 0}, {side, -w, 0}, {0, 2 * w, 0}, {0, -2 * w, w}},
                       {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    }
    case Kind::block: return extrude({{-w, 0}, {w, 0}, {w, s.height_m}, {-w, s.height_m}}, 2 * s.half_depth_m);
    case Kind::wedge: return extrude({{0, 0}, {w, s.height_m}, {-w, s.height_m}}, s.length_m);
    case Kind::file: break;
  }
  return read_triangle_mesh(resolve(s.path, shared), s.unit_m);
}

}  // namespace tacipc::verify
