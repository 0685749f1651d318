#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/base/rng.h"
#include "common/optics/horizon.h"
#include "common/optics/surface_hit.h"
#include "common/optics/trace.h"
#include "tests/common/optics/test_surfaces.h"

namespace tacipc {
namespace trace_geometry_test {

double flat(double, double) { return 0.0; }

/// Cap of radius 4 mm bulging towards the camera, centred on the axis, apex at z = −1 mm.
constexpr double kCapRadius = 4e-3, kCapApex = -1e-3;
double cap(double x, double y) { return kCapApex + kCapRadius - std::sqrt(kCapRadius * kCapRadius - x * x - y * y); }

TEST(VertexNormals, IgnoreHowAFlatRegionIsCut) {
  Positions positions(5, 3);
  positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, -1;
  Triangles triangles(4, 3);  // corner of a cube: floor as two triangles, two walls of one triangle each
  triangles << 0, 1, 2, 0, 2, 3, 0, 4, 1, 0, 3, 4;
  const Vector3 expected = Vector3(-1.0, -1.0, 1.0).normalized();
  EXPECT_LT((vertex_normals(positions, triangles).row(0).transpose() - expected).norm(), 1e-15);
}

TEST(Trace, CapHasTheSphereDepthAndNormals) {
  Sensor sensor = plain_sensor(60, 45);
  sensor.leds = {point_light({0.0, 0.0, -1e-2})};
  const TraceResult result = trace(height_field(2.6e-3, 2.6e-3, 1e-4, cap), sensor, {.subpixels = 1});
  double angle_sum = 0.0;
  for (int row = 0; row < 45; ++row) {
    for (int column = 0; column < 60; ++column) {
      // Ray from the camera at −12 mm against the sphere about (0, 0, apex + R).
      const Vector3 camera(0.0, 0.0, -12e-3), centre(0.0, 0.0, kCapApex + kCapRadius);
      const Vector3 target(4e-3 * ((column + 0.5) / 60 - 0.5), 3e-3 * ((row + 0.5) / 45 - 0.5), 0.0);
      const Vector3 w = (target - camera).normalized(), to_centre = centre - camera;
      const double along = to_centre.dot(w);
      const double t = along - std::sqrt(kCapRadius * kCapRadius - (to_centre - along * w).squaredNorm());
      const Vector3 hit = camera + t * w, normal = (centre - hit).normalized();
      Vector3 found;
      for (int c = 0; c < 3; ++c) found[c] = result.normal.at(column, row, c);
      EXPECT_NEAR(found.norm(), 1.0, 1e-6);
      angle_sum += std::atan2(found.cross(normal).norm(), found.dot(normal));
      // Sagitta of an edge of 0.1 mm, along z: edge²/8 times the sphere's second derivative 1 / (R cos³).
      const double sagitta = 1e-4 * 1e-4 / (8.0 * kCapRadius * std::pow(normal.z(), 3.0));
      EXPECT_NEAR(result.depth.at(column, row, 0), hit.z() - camera.z(), 1.1 * sagitta) << column << ", " << row;
      EXPECT_NEAR(result.indentation.at(column, row, 0), -hit.z(), 1e-6);
    }
  }
  EXPECT_LT(angle_sum / (60 * 45) * 180.0 / std::numbers::pi, 0.1);
}

TEST(Trace, StepCastsItsShadowWhereTheLineOfSightEnds) {
  const Membrane step = step_of_1mm();
  Sensor sensor = plain_sensor(400, 3);
  const double a = 8.0 * kMm, h = 9.0 * kMm, d = 1.0 * kMm;
  sensor.leds = {point_light({a, 0.0, -h})};
  const TraceResult result = trace(step, sensor, {});
  // The line from the light over the edge (0, −d) meets the floor at x = −a d / (h − d).
  const double edge = -a * d / (h - d), column = 400 * (edge / (4.0 * kMm) + 0.5);
  int last_lit = 0;
  while (result.basis.at(last_lit, 1, 0) > 0.0f) ++last_lit;
  EXPECT_NEAR(last_lit, column, 1.0);
  for (int x = last_lit + 1; x < 198; ++x) EXPECT_EQ(result.basis.at(x, 1, 0), 0.0f) << x;
  EXPECT_GT(result.basis.at(250, 1, 0), 0.0f);
}

TEST(Trace, NoRayFallsThroughAndThreadsLeaveNoTrace) {
  // Vertices lie exactly under rays: spacing of the mesh and of the sub-pixels coincide.
  Sensor sensor = plain_sensor(64, 48);
  sensor.leds = {point_light({8e-3, 0.0, -9e-3}), {.position_m = {0.0, 8e-3, -9e-3}, .size_m = {5e-3, 5e-3}}};
  const Membrane grid = height_field(4e-3, 3e-3, 4e-3 / 128, flat);
  const Membrane ball = height_field(4e-3, 3e-3, 1e-4, ball_press);
  for (const Membrane* membrane : {&grid, &ball}) {
    std::vector<TraceResult> results;
    for (const std::size_t threads : {1u, 2u, 5u}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      results.push_back(trace(*membrane, sensor, {}));
      EXPECT_EQ(results.back().outside_rays, 0);
      // Vertex hits alone need the nudge; the ball's vertices are off the rays.
      EXPECT_EQ(results.back().nudged_rays > 0, membrane == &grid) << results.back().nudged_rays;
      for (const float depth : results.back().depth.pixels) ASSERT_FALSE(std::isnan(depth));
    }
    for (const TraceResult& result : results) {
      EXPECT_EQ(result.basis.pixels, results[0].basis.pixels);
      EXPECT_EQ(result.depth.pixels, results[0].depth.pixels);
      EXPECT_EQ(result.normal.pixels, results[0].normal.pixels);
      EXPECT_EQ(result.indentation.pixels, results[0].indentation.pixels);
      EXPECT_EQ(result.nudged_rays, results[0].nudged_rays);
    }
  }
}

TEST(Trace, PixelsBesideTheGelSayThatTheySeeNothing) {
  Sensor sensor = plain_sensor(40, 30);
  sensor.leds = {point_light({0.0, 0.0, -1e-2})};
  const TraceResult result = trace(height_field(1e-3, 1e-3, 1e-4, flat), sensor, {});
  EXPECT_EQ(result.rays, 4 * 40 * 30);
  EXPECT_EQ(result.outside_rays, 4 * (40 * 30 - 20 * 20));
  EXPECT_TRUE(std::isnan(result.depth.at(0, 0, 0)));
  EXPECT_TRUE(std::isnan(result.normal.at(9, 15, 1)));
  EXPECT_EQ(result.basis.at(9, 15, 0), 0.0f);
  EXPECT_NEAR(result.depth.at(10, 15, 0), 12e-3, 1e-9);
}

TEST(Horizon, NeverFreesWhatIsBlocked) {
  // Random rays upwards from a stamped surface: each one that climbs over the bound must be free.
  const auto stamp = [](double x, double y) {
    return -0.4e-3 / (1.0 + std::exp((std::hypot(x - 5e-4, y) - 1e-3) / 6e-5)) - 0.1e-3 * std::sin(2e3 * y);
  };
  const Membrane press = height_field(3e-3, 2.5e-3, 5e-5, stamp);
  const RayScene scene(press.positions, press.triangles);
  const Horizon horizon(press);
  std::uint64_t counter = 0;
  const auto random = [&] { return random_uniform(11, 12, counter++); };
  int freed = 0, blocked = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = 5.6e-3 * (random() - 0.5), y = 4.6e-3 * (random() - 0.5), azimuth = 6.2831853 * random();
    const double climb = 0.5 + 3.0 * random();
    RayPacket down{}, packet{};
    const Ray seen{.origin = {x, y, -2e-3}, .direction = Vector3::UnitZ()};
    down.set(0, seen.origin, seen.direction, 0.0);
    const SurfaceHit hit = surface_hit(press, scene.first_hits(down)[0], seen);
    const Vector3 way(std::cos(azimuth), std::sin(azimuth), -climb);
    packet.set(0, hit.shadow_origin, way.normalized(), 5e-3);
    const bool hidden = scene.blocked(packet) != 0;
    const bool free = climb > horizon.steepness(x, y);
    blocked += hidden;
    freed += free;
    EXPECT_FALSE(hidden && free) << x << " " << y << " " << climb;
  }
  EXPECT_GT(blocked, 100);
  EXPECT_GT(freed, 4000);
  EXPECT_TRUE(std::isinf(horizon.steepness(4e-3, 0.0)));
  // An overhang frees nothing near it.
  Positions fold(4, 3);
  fold << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  Triangles sides(2, 3);
  sides << 0, 1, 2, 0, 1, 3;
  EXPECT_TRUE(std::isinf(Horizon(make_membrane(fold, fold, sides)).steepness(0.1, 0.1)));
}

TEST(InsideOutline, FollowsTheWindingOfTheBoundary) {
  const Membrane square = height_field(1e-3, 1e-3, 1e-3, flat);
  const auto inside = [&](double x, double y) {
    return inside_outline(square, {.origin = {x, y, -1e-2}, .direction = Vector3::UnitZ()});
  };
  EXPECT_TRUE(inside(0.0, 0.0));
  EXPECT_TRUE(inside(0.999e-3, -0.999e-3));
  EXPECT_FALSE(inside(1.001e-3, 0.0));
  EXPECT_FALSE(inside(1e-3, 0.5e-3));  // on the boundary: either answer of a ray is right
}

TEST(MakeMembrane, TakesTheFrontFacesOnly) {
  TetMesh gel;
  gel.positions.resize(5, 3);
  gel.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1, 9, 9, 9;
  gel.tets.resize(1, 4);
  gel.tets << 0, 2, 1, 3;
  gel.boundary.resize(4, 3);
  gel.boundary << 0, 1, 2, 0, 3, 1, 1, 3, 2, 0, 2, 3;
  gel.tags = {BoundaryTag::front, BoundaryTag::side, BoundaryTag::side, BoundaryTag::glued};
  Positions moved = gel.positions;
  moved(1, 2) = -0.5;
  const Membrane membrane = make_membrane(gel, moved);
  ASSERT_EQ(membrane.triangles.rows(), 1);
  ASSERT_EQ(membrane.positions.rows(), 3);
  EXPECT_EQ(membrane.positions(1, 2), -0.5);
  EXPECT_EQ(membrane.rest(1, 2), 0.0);
  EXPECT_EQ(membrane.outline.size(), 3u);

  gel.tags[0] = BoundaryTag::side;
  EXPECT_THAT([&] { make_membrane(gel, moved); },
              ::testing::ThrowsMessage<DataError>("the gel has no triangle tagged as front face"));
  gel.positions.conservativeResize(6, 3);
  gel.positions.row(5) << 8, 8, 8;
  moved.conservativeResize(6, 3);
  moved.row(5) << 8, 8, 8;
  gel.boundary.resize(2, 3);
  gel.boundary << 0, 1, 2, 3, 4, 5;
  gel.tags = {BoundaryTag::front, BoundaryTag::front};
  EXPECT_THAT([&] { make_membrane(gel, moved); },
              ::testing::ThrowsMessage<DataError>(
                  "the gel's front face has 2 boundary loops; it must be one piece without holes"));
}

}  // namespace trace_geometry_test
}  // namespace tacipc
