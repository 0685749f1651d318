#include "common/optics/indirect.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/base/sobol.h"
#include "common/optics/trace.h"
#include "tests/common/optics/test_surfaces.h"

namespace tacipc {
namespace indirect_test {

double flat(double, double) { return 0.0; }

TEST(Sobol, PutsOnePointIntoEveryBoxOfAPowerOfTwo) {
  for (int bits = 1; bits <= 8; ++bits) {
    for (int across = 0; across <= bits; ++across) {
      const int columns = 1 << across, rows = 1 << (bits - across);
      std::vector<int> filled(static_cast<std::size_t>(columns * rows), 0);
      for (std::uint32_t i = 0; i < (1u << bits); ++i) {
        const std::array point{sobol(i, 0), sobol(i, 1)};
        ++filled[static_cast<std::size_t>(static_cast<int>(point[0] * columns) * rows +
                                          static_cast<int>(point[1] * rows))];
      }
      for (const int count : filled) ASSERT_EQ(count, 1) << bits << " bits, " << columns << " columns";
    }
  }
}

TEST(Fresnel, ReflectanceFromInside) {
  EXPECT_NEAR(fresnel_reflectance(0.0, 1.49, 1.0), 0.03873, 5e-6);
  EXPECT_EQ(fresnel_reflectance(0.7, 1.49, 1.0), 1.0);  // beyond asin(1/1.49) = 42.2°
  EXPECT_NEAR(fresnel_reflectance(0.3, 1.41, 1.0), fresnel_reflectance(0.3 * 1.41, 1.0, 1.41), 1e-14);  // both ways
}

TEST(GatherIndirect, BowlSendsToItselfWhatTheIntegratingSphereSays) {
  // On a sphere every element sees every other with the form factor dA / 4πR², so a bowl of unit radiance returns its
  // area's share of the whole sphere, everywhere alike.
  constexpr double kRadius = 3e-3;
  const Membrane bowl = height_field(
      1.6e-3, 1.6e-3, 1e-4, [](double x, double y) { return std::sqrt(kRadius * kRadius - x * x - y * y) - kRadius; });
  double area = 0.0;
  for (Eigen::Index f = 0; f < bowl.triangles.rows(); ++f) {
    const Vector3 a = bowl.positions.row(bowl.triangles(f, 0)).transpose();
    const Vector3 b = bowl.positions.row(bowl.triangles(f, 1)).transpose();
    const Vector3 c = bowl.positions.row(bowl.triangles(f, 2)).transpose();
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  const double expected = area / (4.0 * std::numbers::pi * kRadius * kRadius);
  const RayScene scene(bowl.positions, bowl.triangles);
  const VertexLight one = VertexLight::Ones(bowl.positions.rows(), 1);
  const VertexLight gathered = gather_indirect(scene, bowl, one, plain_sensor(1, 1), 1024, true);
  double sum = 0.0;
  int inside = 0;
  for (Eigen::Index v = 0; v < bowl.positions.rows(); ++v) {
    if (bowl.positions.row(v).head<2>().cwiseAbs().maxCoeff() > 1.5e-3) continue;  // normals at the rim are one-sided
    EXPECT_NEAR(gathered(v, 0) / expected, 1.0, 0.12) << v;
    sum += gathered(v, 0);
    ++inside;
  }
  EXPECT_NEAR(sum / inside / expected, 1.0, 0.01);
}

TEST(GatherIndirect, FlatGelGetsBackWhatTheWindowReflects) {
  // ∫ R(θ) cos θ dω / π over the half space of the gel: half of a Lambert surface's light is beyond the critical angle.
  constexpr int kSteps = 200000;
  double expected = 0.0;
  for (int i = 0; i < kSteps; ++i) expected += fresnel_reflectance(std::sqrt((i + 0.5) / kSteps), 1.41, 1.0) / kSteps;
  EXPECT_GT(expected, 1.0 - 1.0 / (1.41 * 1.41));
  Sensor sensor = plain_sensor(1, 1);
  sensor.gel.width_m = sensor.gel.height_m = 0.4;
  sensor.stack = {.gel_thickness_m = 2e-3, .gel_ior = 1.41};
  const Membrane plane = height_field(0.2, 0.2, 0.02, flat);
  const RayScene scene(plane.positions, plane.triangles);
  const VertexLight one = VertexLight::Ones(plane.positions.rows(), 1);
  const auto middle = [&] {
    const VertexLight gathered = gather_indirect(scene, plane, one, sensor, 4096, true);
    double sum = 0.0;
    int count = 0;
    for (Eigen::Index v = 0; v < plane.positions.rows(); ++v) {
      if (plane.positions.row(v).head<2>().norm() > 0.03) continue;
      sum += gathered(v, 0);
      ++count;
    }
    return sum / count;
  };
  EXPECT_NEAR(middle() / expected, 1.0, 0.005);
  // A layer between changes the angles on the way, not where total reflection begins; its own face adds next to
  // nothing.
  sensor.stack.layers = {{.name = "acrylic", .thickness_m = 5e-3, .ior = 1.49}};
  EXPECT_NEAR(middle() / expected, 1.0, 0.02);
  sensor.stack.gel_ior.reset();
  sensor.stack.layers.clear();
  EXPECT_EQ(middle(), 0.0);  // without an index nothing is reflected, and a plane does not see itself
}

TEST(Trace, IndirectLightIsAddedOnceAndLeavesTheRestAlone) {
  Sensor sensor = plain_sensor(40, 30);
  sensor.stack = {
      .gel_thickness_m = 2e-3, .gel_ior = 1.41, .layers = {{.name = "acrylic", .thickness_m = 1e-3, .ior = 1.49}}};
  sensor.gel.width_m = sensor.gel.height_m = 24e-3;
  sensor.coating.albedo = {0.5, 0.25, 0.5};
  sensor.leds = {point_light({8e-3, 2e-3, -8e-3})};
  const Membrane ball = height_field(12e-3, 12e-3, 3e-4, ball_press);
  const TraceResult without = trace(ball, sensor, {}), with = trace(ball, sensor, {.indirect_rays = 64});
  EXPECT_EQ(with.basis.pixels, without.basis.pixels);
  EXPECT_EQ(indirect_share(without, sensor), 0.0);
  const FloatImage image = color_image(with, sensor, false), plain = color_image(without, sensor, false);
  EXPECT_NEAR(image.at(20, 15, 0), plain.at(20, 15, 0) + 0.25 * with.indirect.at(20, 15, 0),
              1e-5 * image.at(20, 15, 0));
  EXPECT_NEAR(image.at(20, 15, 1), plain.at(20, 15, 1) + 0.0625 * with.indirect.at(20, 15, 0),
              1e-5 * image.at(20, 15, 1));
  // At most the whole internal reflectance (0.52) times albedo comes back, less what leaves at the sides.
  EXPECT_GT(indirect_share(with, sensor), 0.03);
  EXPECT_LT(indirect_share(with, sensor), 0.25);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(trace(ball, sensor, {.indirect_rays = 64}).indirect.pixels, with.indirect.pixels);
}

}  // namespace indirect_test
}  // namespace tacipc
