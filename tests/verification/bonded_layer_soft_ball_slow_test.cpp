// A soft ball that a plate presses onto a gel of another modulus, against the exact linear solution for both.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "stages/gel/press/contact/distance.h"
#include "stages/gel/press/drive/scene.h"
#include "stages/gel/press/energy/elasticity.h"
#include "stages/gel/tetmesh/delaunay.h"
#include "stages/gel/tetmesh/tet_fill.h"
#include "verification/bonded_layer.h"
#include "verification/gel_shapes.h"
#include "verification/object_shapes.h"

namespace tacipc::verify {
namespace bonded_layer_soft_ball_slow_test {

using std::numbers::pi;

// The gel is eight contact radii thick and sixteen wide, the contact eight edges and a thirty-third of the ball's
// radius: a ball pressed at both poles yields by 0.5 % less at each than a half space does (its exact compliance, a sum
// of Legendre polynomials), which makes the force 0.5 % larger. Found are 2.3 % too much, the rest by the mesh: 1.5 %
// with edges of 0.8 times the length that grow by three quarters as much. Half of d̂ changes the force by 0.1 %.
constexpr double kRadius = 20e-3, kThickness = 5e-3, kWidth = 10e-3;
constexpr double kFine = 0.9e-3, kEdge = 0.075e-3, kGrowth = 0.22;  // of the ball's mesh
constexpr double kDHat = 1e-6, kDown = 30e-6;
const Elastic kGel{1.2e5, 0.43}, kBall{6e4, 0.3};

/// Edges of the ball's mesh: fine near its lowest point, coarser near its highest, growing in between.
double edge_at(const Vector3& point) {
  const double low = (point + Vector3(0, 0, kRadius)).norm() - kFine, high = (point - Vector3(0, 0, kRadius)).norm();
  return std::min({kEdge + kGrowth * std::max(0.0, low), 3.0 * kEdge + kGrowth * high, 0.25 * kRadius});
}

/// A ball around the origin: rings of points as far apart as the edges are long, joined by the triangles of Delaunay of
/// their stereographic projection, which are those of the sphere, and filled with tetrahedra.
TetMesh make_soft_ball() {
  std::vector<Vector3> points{{0, 0, -kRadius}};
  std::vector<Vector2> projected{{0, 0}};
  int ring = 0, in_ring = 0;
  for (double angle = 0.0;; ++ring) {
    angle += std::sqrt(0.75) * edge_at(points.back()) / kRadius;
    if (angle > pi - std::sqrt(0.75) * edge_at({0, 0, kRadius}) / kRadius) break;
    const double length = 2.0 * pi * kRadius * std::sin(angle);
    const Vector3 at(kRadius * std::sin(angle), 0, -kRadius * std::cos(angle));
    in_ring = std::max(6, static_cast<int>(std::lround(length / edge_at(at))));
    for (int k = 0; k < in_ring; ++k) {
      const double turn = 2.0 * pi * (k + 0.5 * (ring % 2)) / in_ring;
      points.emplace_back(at.x() * std::cos(turn), at.x() * std::sin(turn), at.z());
      projected.emplace_back(std::tan(0.5 * angle) * Vector2(std::cos(turn), std::sin(turn)));
    }
  }
  const auto top = static_cast<int>(points.size());
  points.emplace_back(0, 0, kRadius);
  const Triangles below = delaunay(projected);
  GelSurface surface;
  surface.positions.resize(top + 1, 3);
  for (int v = 0; v <= top; ++v) surface.positions.row(v) = points[static_cast<std::size_t>(v)];
  surface.triangles.resize(below.rows() + in_ring, 3);
  surface.triangles.topRows(below.rows()) << below.col(0), below.col(2), below.col(1);  // seen from below
  for (int k = 0; k < in_ring; ++k)
    surface.triangles.row(below.rows() + k) << top, top - in_ring + k, top - in_ring + (k + 1) % in_ring;
  surface.tags.assign(static_cast<std::size_t>(surface.triangles.rows()), BoundaryTag::free);
  return fill_with_tets(surface,
                        {.radius_edge_ratio = 1.4,
                         .circumradius_ratio = 0.85,
                         .min_dihedral_deg = 12.0,
                         .optimization_level = 4,
                         .smoothing_sweeps = 5},
                        edge_at);
}

/// Mean distance of the gel's front from the ball where they press on each other, by force.
double stand_off_m(const Simulation& gel, const Frame& frame, const Positions& ball, const Triangles& triangles) {
  double sum = 0.0, force = 0.0;
  for (std::size_t i = 0; i < gel.front.vertices.size(); ++i) {
    const double normal_n = frame.normal_force_n.row(static_cast<Eigen::Index>(i)).norm();
    if (normal_n == 0.0) continue;
    const Vector3 point = frame.positions.row(gel.front.vertices[i]);
    double nearest = 1.0;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
      const Vector3 a = ball.row(triangles(t, 0));
      if ((a - point).norm() > 1e-3) continue;
      const ClosestFeature found =
          closest_point_triangle({point, a, Vector3(ball.row(triangles(t, 1))), Vector3(ball.row(triangles(t, 2)))});
      nearest = std::min(nearest, found.squared_distance);
    }
    sum += normal_n * std::sqrt(nearest);
    force += normal_n;
  }
  return sum / force;
}

Material material(const Elastic& elastic, double density_kg_m3) {
  return {.law = "neo_hookean",
          .density_kg_m3 = density_kg_m3,
          .youngs_modulus_pa = elastic.youngs_modulus_pa,
          .poissons_ratio = elastic.poissons_ratio};
}

Matrix4 at_height(double z) {
  Matrix4 pose = Matrix4::Identity();
  pose(2, 3) = z;
  return pose;
}

/// Held long enough for the ball to come to rest.
SceneSpec plate_presses_ball_onto_gel() {
  SceneSpec spec;
  spec.gravity_m_s2.setZero();
  spec.bodies = {{.name = "gel", .kind = BodyKind::gel},
                 {.name = "ball", .kind = BodyKind::soft, .world_from_body = at_height(kRadius + kDHat)},
                 {.name = "plate",
                  .kind = BodyKind::rigid,
                  .world_from_body = at_height(2.0 * (kRadius + kDHat)),
                  .mass = {.mass_kg = 1.0}}};
  spec.motion = {{.steps = 1, .move = {{.body = 2, .way = {.shift_m = {0, 0, -kDown - 2.0 * kDHat}}}}},
                 {.steps = 5, .hold = {2}}};
  return spec;
}

PressConfig precise_config(const TetMesh& gel) {
  const Vector3 extent = gel.positions.colwise().maxCoeff() - gel.positions.colwise().minCoeff();
  PressConfig config;
  config.time_step_s = 0.02;
  config.element = "averaged_volume";
  config.relative_d_hat = kDHat / extent.norm();
  config.start_gap_d_hat = 1.0;
  config.relative_barrier_stiffness = 0.02;
  config.pair_counting.once = true;
  config.relative_velocity_tolerance = 1e-5;
  config.newton.relative_force_tolerance = 1e-4;
  config.newton.force_tolerance_n = 1e-7;
  config.newton.max_iterations = 300;
  return config;
}

/// The ball's depth is how far its centre of mass has come towards the gel's back, and what the barrier keeps between
/// them counts as part of it. Nothing rubs.
TEST(SoftBall, PressesAGelAsBothModuliTogetherSay) {
  const GelSpec gel_spec{RingGel{.radius_m = kWidth,
                                 .thickness_m = kThickness,
                                 .sectors = 32,
                                 .focus_from_m = 0.0,
                                 .focus_to_m = kFine,
                                 .near_m = kEdge,
                                 .growth = 1.2,
                                 .far_m = 3e-3,
                                 .layer_m = kEdge,
                                 .layer_growth = 1.2}};
  const TetMesh gel = make_gel(gel_spec, {}), ball = make_soft_ball();
  Sensor sensor;
  sensor.gel = shape_of(gel_spec, gel);
  sensor.material = material(kGel, 1000.0);
  const TriangleMesh plate = make_object({.kind = ObjectShape::Kind::plate, .half_width_m = 5e-3}, {});
  const Scene scene = run_scene(sensor,
                                {{.tets = gel, .material = sensor.material},
                                 {.tets = ball, .material = material(kBall, 100.0)},
                                 {.surface = plate}},
                                precise_config(gel), plate_presses_ball_onto_gel(), [](int, int, int, double) {});
  const SceneFrame& end = scene.frames.back();
  const double force_n = -end.between[0 * 3 + 1].force_n.z(), by_plate_n = -end.between[1 * 3 + 2].force_n.z();
  EXPECT_NEAR(by_plate_n, force_n, 2e-3 * force_n);  // at rest
  const Eigen::VectorXd mass =
      lumped_masses(ball.tets, make_rest_tets(ball.positions, ball.tets), ball.num_vertices(), 1.0);
  // Its facets have it elsewhere than the sphere has, so the way counts.
  const Eigen::RowVector3d center = mass.transpose() * (end.soft_m[0] - ball.positions) / mass.sum();
  const double depth_m =
      kRadius - center.z() + stand_off_m(scene.gels[0], scene.gels[0].frames.back(), end.soft_m[0], ball.boundary);
  const LayerSolution expected =
      press_bonded_layer({kGel, kThickness, LayerProblem::Shape::sphere, kRadius, kBall}, depth_m);
  EXPECT_NEAR(force_n, expected.force_n, 0.03 * expected.force_n);
  EXPECT_GT(expected.contact_radius_m, 8.0 * kEdge);
}

}  // namespace bonded_layer_soft_ball_slow_test
}  // namespace tacipc::verify
