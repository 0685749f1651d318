#include "verification/stress_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "common/base/error.h"
#include "stages/gel/press/measure/front_surface.h"
#include "tests/make_mesh.h"
#include "verification/gel_shapes.h"
#include "verification/object_shapes.h"

namespace tacipc::verify {
namespace {

double volume6(const Positions& x, const auto& tet) {
  Matrix3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = x.row(tet[k + 1]) - x.row(tet[0]);
  return edges.determinant();
}

/// Number of vertices of the mesh that box_mesh makes from a box.
double count_of(const BoxGel& box) {
  const auto lines = [&](double size) {
    return static_cast<double>(
        graded_lines(size / 2, box.near_m, box.near_half_m, box.growth, box.far_m, std::nullopt).size());
  };
  double layers = 1.0, covered = 0.0;
  for (double step = box.layer_m; covered < box.thickness_m; step *= box.layer_growth, ++layers) covered += step;
  return lines(box.width_m) * lines(box.height_m) * layers;
}

GelSpec draw_box(const StressConfig::Gel& ranges, double thickness_m, double vertices, Draws& draws) {
  BoxGel box;
  box.thickness_m = thickness_m;
  box.width_m = thickness_m * draws.in(ranges.width_thicknesses);
  box.height_m = thickness_m * draws.in(ranges.width_thicknesses);
  box.growth = draws.in(ranges.growth);
  box.layer_growth = draws.in(ranges.growth);
  box.near_half_m = 0.25 * draws.unit() * std::min(box.width_m, box.height_m);
  const double flatness = draws.in({0.5, 1.0});  // thickness of the first layer over the cell width
  for (double cell = thickness_m;; cell *= 0.98) {
    box.near_m = cell;
    box.far_m = std::max(cell, 0.5 * thickness_m);
    box.layer_m = flatness * cell;
    if (count_of(box) >= vertices) break;
  }
  return {.shape = box};
}

GelSpec draw_disc(const StressConfig::Gel& ranges, double thickness_m, double vertices, Draws& draws) {
  DiscGel disc;
  disc.thickness_m = thickness_m;
  disc.radius_m = 0.5 * thickness_m * draws.in(ranges.width_thicknesses);
  const double growth = draws.in(ranges.growth), back = draws.in(ranges.growth), part = draws.in({0.1, 0.4});
  GelShape shape;
  shape.outline = GelShape::Outline::disc;
  shape.radius_m = disc.radius_m;
  shape.thickness_m = thickness_m;
  for (double edge = thickness_m;; edge *= 0.98) {
    disc.sizing = {.centre_m = edge,
                   .centre_radius_m = part * disc.radius_m,
                   .inner_m = growth * edge,
                   .inner_radius_m = (part + 0.4) * disc.radius_m,
                   .rim_m = growth * growth * edge,
                   .back_m = back * edge};
    if (estimated_vertices(sizing_for(disc.sizing, shape)) >= vertices) break;
  }
  return {.shape = disc};
}

using std::numbers::pi;

double longest_edge_m(const TriangleMesh& mesh) {
  double longest = 0.0;
  for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f) {
    for (int k = 0; k < 3; ++k) {
      longest = std::max(
          longest,
          (mesh.positions.row(mesh.triangles(f, k)) - mesh.positions.row(mesh.triangles(f, (k + 1) % 3))).norm());
    }
  }
  return longest;
}

double largest_extent(const Positions& x) { return (x.colwise().maxCoeff() - x.colwise().minCoeff()).maxCoeff(); }

/// Pyramid with the tip down at the origin, n sides, height 1.
TriangleMesh pyramid(int sides, double half_angle_rad) {
  std::vector<Vector3> points{Vector3::Zero()};
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * pi * i / sides, radius = std::tan(half_angle_rad);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 1.0);
    const int a = 1 + i, b = 1 + (i + 1) % sides;
    triangles.push_back({0, b, a});
    if (i > 0 && i + 1 < sides) triangles.push_back({1, a, b});
  }
  return make_mesh(points, triangles);
}

/// Sphere of radius 1 with bumps and dents at random positions.
TriangleMesh blob(int n, Draws& draws) {
  TriangleMesh mesh = octahedral_sphere(n);
  struct Bump {
    Vector3 at;
    double height, width;
  };
  std::vector<Bump> bumps(static_cast<std::size_t>(3 + draws.below(8)));
  for (Bump& bump : bumps) {
    const double z = draws.in({-1.0, 1.0}), angle = draws.in({0.0, 2.0 * pi}), r = std::sqrt(1.0 - z * z);
    bump = {{r * std::cos(angle), r * std::sin(angle), z}, draws.in({-0.3, 0.5}), draws.in({0.2, 0.6})};
  }
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v) {
    const Vector3 at = mesh.positions.row(v);
    double radius = 1.0;
    for (const Bump& bump : bumps)
      radius += bump.height * std::exp(-(at - bump.at).squaredNorm() / (bump.width * bump.width));
    mesh.positions.row(v) = std::max(radius, 0.3) * at;
  }
  return mesh;
}

/// Uniformly random rotation, from (0, 1)³ (Shoemake).
Matrix3 any_rotation(Draws& draws) {
  const double u = draws.unit(), a = 2.0 * pi * draws.unit(), b = 2.0 * pi * draws.unit();
  return Eigen::Quaterniond(std::sqrt(u) * std::cos(b), std::sqrt(1.0 - u) * std::sin(a),
                            std::sqrt(1.0 - u) * std::cos(a), std::sqrt(u) * std::sin(b))
      .toRotationMatrix();
}

Matrix3 leaning(double tilt_rad, double direction_rad) {
  const Vector3 axis(-std::sin(direction_rad), std::cos(direction_rad), 0.0);
  return Eigen::AngleAxisd(tilt_rad, axis).toRotationMatrix();
}

/// Number of edges on a circle of this radius, each no longer than `edge`.
int pieces(double radius, double edge, int least) {
  return std::max(least, static_cast<int>(std::ceil(2.0 * pi * radius / edge)));
}

}  // namespace

StressGel draw_gel(const StressConfig::Gel& ranges, double exact_share, Draws& draws) {
  const bool round = draws.chance(ranges.disc_share);
  const double thickness_m = draws.in(ranges.thickness_m), vertices = draws.in(ranges.vertices);
  const GelSpec spec =
      round ? draw_disc(ranges, thickness_m, vertices, draws) : draw_box(ranges, thickness_m, vertices, draws);
  StressGel gel;
  gel.mesh = make_gel(spec, {});
  gel.shape = shape_of(spec, gel.mesh);
  const double jitter = draws.in(ranges.jitter);
  if (!draws.chance(exact_share)) jitter_vertices(gel.mesh, jitter, draws);
  gel.front_edge_m = median_front_edge_m(gel.mesh);
  return gel;
}

void jitter_vertices(TetMesh& mesh, double part, Draws& draws) {
  const auto count = static_cast<std::size_t>(mesh.num_vertices());
  std::vector<bool> fixed(count, false), front(count, false);
  for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.boundary(static_cast<Eigen::Index>(f), k);
      (mesh.tags[f] == BoundaryTag::front ? front : fixed)[static_cast<std::size_t>(v)] = true;
    }
  }
  std::vector<std::vector<Eigen::Index>> tets_of(count);
  std::vector<double> volume(static_cast<std::size_t>(mesh.num_tets()));
  for (Eigen::Index t = 0; t < mesh.num_tets(); ++t) {
    for (int k = 0; k < 4; ++k) tets_of[static_cast<std::size_t>(mesh.tets(t, k))].push_back(t);
    volume[static_cast<std::size_t>(t)] = volume6(mesh.positions, mesh.tets.row(t));
  }
  for (std::size_t v = 0; v < count; ++v) {
    if (fixed[v]) continue;
    const auto row = static_cast<Eigen::Index>(v);
    const Vector3 before = mesh.positions.row(row);
    double shortest = std::numeric_limits<double>::infinity();
    for (const Eigen::Index t : tets_of[v]) {
      for (int k = 0; k < 4; ++k) {
        const double length = (mesh.positions.row(mesh.tets(t, k)).transpose() - before).norm();
        if (length > 0.0) shortest = std::min(shortest, length);
      }
    }
    Vector3 move;
    for (int k = 0; k < 3; ++k) move[k] = draws.in({-1.0, 1.0});
    if (front[v]) move.z() = 0.0;
    mesh.positions.row(row) = before + part * shortest * move;
    const bool flat = std::any_of(tets_of[v].begin(), tets_of[v].end(), [&](Eigen::Index t) {
      return volume6(mesh.positions, mesh.tets.row(t)) < 0.25 * volume[static_cast<std::size_t>(t)];
    });
    if (flat) mesh.positions.row(row) = before;
  }
}

TriangleMesh split_triangles(TriangleMesh mesh, double edge_m, int max_vertices) {
  while (longest_edge_m(mesh) > edge_m && 4 * mesh.num_vertices() <= max_vertices) {
    std::vector<Vector3> points;
    for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v) points.emplace_back(mesh.positions.row(v));
    std::map<std::pair<int, int>, int> middle;
    const auto middle_of = [&](int a, int b) {
      const auto [found, is_new] = middle.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (is_new) points.emplace_back(0.5 * (points[a] + points[b]));
      return found->second;
    };
    std::vector<std::array<int, 3>> triangles;
    for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f) {
      const int a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
      const int ab = middle_of(a, b), bc = middle_of(b, c), ca = middle_of(c, a);
      for (const std::array<int, 3>& part :
           {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}})
        triangles.push_back(part);
    }
    mesh = make_mesh(points, triangles);
  }
  return mesh;
}

TriangleMesh octahedral_sphere(int n) {
  std::vector<Vector3> points;
  std::vector<std::array<int, 3>> triangles;
  std::map<std::array<int, 3>, int> number;
  for (int octant = 0; octant < 8; ++octant) {
    const int sx = octant & 1 ? -1 : 1, sy = octant & 2 ? -1 : 1, sz = octant & 4 ? -1 : 1;
    const auto vertex = [&](int i, int j) {
      const std::array<int, 3> at{sx * i, sy * j, sz * (n - i - j)};
      const auto [found, is_new] = number.try_emplace(at, static_cast<int>(points.size()));
      if (is_new) points.push_back(Vector3(at[0], at[1], at[2]).normalized());
      return found->second;
    };
    const auto add = [&](int a, int b, int c) {
      if (sx * sy * sz < 0) std::swap(b, c);
      triangles.push_back({a, b, c});
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        add(vertex(i, j), vertex(i + 1, j), vertex(i, j + 1));
        if (i + j + 1 < n) add(vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
      }
    }
  }
  return make_mesh(points, triangles);
}

TriangleMesh torus(double tube, int around, int across) {
  std::vector<Vector3> points;
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2.0 * pi * i / around, v = 2.0 * pi * j / across, radius = 1.0 + tube * std::cos(v);
      points.emplace_back(radius * std::cos(u), radius * std::sin(u), tube * std::sin(v));
      const int a = i * across + j, b = (i + 1) % around * across + j;
      const int c = (i + 1) % around * across + (j + 1) % across, d = i * across + (j + 1) % across;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return make_mesh(points, triangles);
}

double contact_radius_m(const TriangleMesh& mesh, double depth_m) {
  const double level = mesh.positions.col(2).minCoeff() + depth_m;
  std::vector<Eigen::Vector2d> points;
  for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Vector3 a = mesh.positions.row(mesh.triangles(f, k)),
                    b = mesh.positions.row(mesh.triangles(f, (k + 1) % 3));
      if (a.z() <= level) points.emplace_back(a.head<2>());
      if ((a.z() <= level) != (b.z() <= level)) {
        const Vector3 at = a + (level - a.z()) / (b.z() - a.z()) * (b - a);
        points.emplace_back(at.head<2>());
      }
    }
  }
  Eigen::Vector2d low = points.front(), high = points.front();
  for (const auto& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  double radius = 0.0;
  for (const auto& p : points) radius = std::max(radius, (p - 0.5 * (low + high)).norm());
  return radius;
}

StressObject draw_object(const StressConfig::Object& ranges, double gel_edge_m, Draws& draws) {
  StressObject object;
  object.kind = ranges.kinds[static_cast<std::size_t>(draws.below(static_cast<int>(ranges.kinds.size())))];
  object.size_m = draws.in(ranges.size_m);
  object.edge_m = gel_edge_m * draws.log(ranges.edges_over_gel);
  const double half_angle = draws.in(ranges.half_angle_rad);
  const bool upright = draws.chance(ranges.exact_share);
  object.tilt_rad = upright ? 0.0 : draws.in({0.0, ranges.tilt_rad});
  const double direction = draws.in({0.0, 2.0 * pi}), spin = draws.in({0.0, 2.0 * pi});
  const Matrix3 spun = Eigen::AngleAxisd(spin, Vector3::UnitZ()).toRotationMatrix();
  Matrix3 turn = leaning(object.tilt_rad, direction) * spun;

  // Every shape is first made in a size of about 1; `edge` is the target edge length at that size, limited by the
  // number of vertices.
  const auto edge_for = [&](double extent, double area) {
    return std::max(object.edge_m * extent / object.size_m, std::sqrt(1.16 * area / ranges.max_vertices));
  };
  if (object.kind == "cone") {
    const double radius = std::tan(half_angle), slope = std::hypot(1.0, radius);
    object.half_angle_rad = half_angle;
    ObjectShape cone{.kind = ObjectShape::Kind::cone, .radius_m = radius, .height_m = 1.0};
    cone.edge_m = edge_for(std::max(1.0, 2.0 * radius), pi * radius * slope);
    object.mesh = make_object(cone, {});
  } else if (object.kind == "pyramid") {
    object.half_angle_rad = half_angle;
    object.mesh = pyramid(3 + draws.below(4), half_angle);
  } else if (object.kind == "wedge") {
    object.half_angle_rad = half_angle;
    const double half_width = std::tan(half_angle);
    object.mesh = extrude({{0.0, 0.0}, {half_width, 1.0}, {-half_width, 1.0}}, draws.in({0.3, 2.0}));
  } else if (object.kind == "box") {
    const double a = draws.in({0.2, 1.0}), b = draws.in({0.2, 1.0});
    object.mesh = extrude({{-a / 2, -b / 2}, {a / 2, -b / 2}, {a / 2, b / 2}, {-a / 2, b / 2}}, 1.0);
    const int stands_on = draws.below(3);  // 0: on a corner, 1: on an edge, 2: on a face
    const Matrix3 any = any_rotation(draws);
    const double roll = draws.in({0.0, pi / 2});
    object.tilt_rad = 0.0;
    if (stands_on == 0) turn = any;
    if (stands_on > 0) {
      turn = spun * Eigen::AngleAxisd(stands_on == 1 ? roll : 0.0, Vector3::UnitY()).toRotationMatrix();
    }
  } else if (object.kind == "sphere" || object.kind == "blob") {
    const double edge = edge_for(2.0, 4.0 * pi);
    const int n = std::max(2, static_cast<int>(std::ceil(pi / 2 / edge)));
    object.mesh = object.kind == "sphere" ? octahedral_sphere(n) : blob(n, draws);
    turn = any_rotation(draws);
  } else if (object.kind == "cylinder") {
    const double radius = draws.in({0.1, 0.5});
    const int sides = pieces(radius, edge_for(1.0, 2.0 * pi * radius), 8);
    std::vector<Eigen::Vector2d> polygon;
    for (int i = 0; i < sides; ++i)
      polygon.emplace_back(radius * std::sin(2.0 * pi * i / sides), -radius * std::cos(2.0 * pi * i / sides));
    object.mesh = extrude(polygon, 1.0);
  } else {
    const double tube = draws.in({0.2, 0.6});
    const double edge = edge_for(2.0 + 2.0 * tube, 4.0 * pi * pi * tube);
    object.mesh = torus(tube, pieces(1.0, edge, 8), pieces(tube, edge, 5));
  }
  object.mesh.positions *= object.size_m / largest_extent(object.mesh.positions);
  if (object.kind == "pyramid" || object.kind == "wedge" || object.kind == "box" || object.kind == "cylinder")
    object.mesh = split_triangles(std::move(object.mesh), object.edge_m, ranges.max_vertices);
  object.mesh.positions *= turn.transpose();
  object.mesh.positions.col(2).array() -= object.mesh.positions.col(2).minCoeff();
  return object;
}

}  // namespace tacipc::verify
