// Objects that the harness makes: closed, outward, lowest point at zero.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/closed_surface.h"
#include "verification/object_shapes.h"

namespace tacipc::verify {
namespace object_shapes_test {

using std::numbers::pi;
using Kind = ObjectShape::Kind;

struct ObjectCase {
  std::string name;
  ObjectShape shape;
  double volume_m3;
  double tolerance;
};

class ObjectTest : public ::testing::TestWithParam<ObjectCase> {};

TEST_P(ObjectTest, IsClosedOutwardAndStandsOnZero) {
  const TriangleMesh mesh = make_object(GetParam().shape, "");
  expect_closed(mesh.triangles);
  EXPECT_NEAR(signed_volume(mesh) / GetParam().volume_m3, 1.0, GetParam().tolerance);
  EXPECT_NEAR(mesh.positions.col(2).minCoeff(), 0.0, 1e-15);
  // Centred by its bounding box, as the press places it, over the origin.
  const Vector3 centre = 0.5 * (mesh.positions.colwise().minCoeff() + mesh.positions.colwise().maxCoeff());
  EXPECT_LT(centre.head<2>().norm(), 0.02 * mesh.positions.cwiseAbs().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ObjectTest,
    ::testing::Values(
        ObjectCase{"sphere",
                   {.kind = Kind::sphere, .radius_m = 0.01, .edge_m = 2e-4, .fine_radius_m = 0.001},
                   4.0 / 3.0 * pi * 1e-6,
                   0.12},
        ObjectCase{"punch",
                   {.kind = Kind::punch, .radius_m = 0.01, .edge_m = 3e-4, .height_m = 0.005},
                   pi * 1e-4 * 0.005,
                   0.002},
        ObjectCase{"punch_with_fillet",
                   {.kind = Kind::punch, .radius_m = 0.01, .edge_m = 1e-4, .fillet_m = 0.001, .height_m = 0.005},
                   pi * 1e-4 * 0.005,
                   0.01},
        ObjectCase{"cone",
                   {.kind = Kind::cone, .radius_m = 0.01, .edge_m = 2e-4, .height_m = 0.006},
                   pi * 1e-4 * 0.002,
                   0.002},
        ObjectCase{"cylinder",
                   {.kind = Kind::cylinder, .radius_m = 0.01, .edge_m = 2e-4, .length_m = 0.03},
                   pi * 1e-4 * 0.03,
                   0.002},
        ObjectCase{"plate", {.kind = Kind::plate, .half_width_m = 0.01}, std::sqrt(3.0) * 1e-6, 1e-12},
        ObjectCase{"block",
                   {.kind = Kind::block, .height_m = 0.002, .half_width_m = 0.01, .half_depth_m = 0.005},
                   4e-7,
                   1e-12},
        ObjectCase{
            "wedge", {.kind = Kind::wedge, .height_m = 0.002, .length_m = 0.01, .half_width_m = 0.003}, 6e-8, 1e-12}),
    [](const auto& test) { return test.param.name; });

TEST(ObjectShapes, SphereHasItsVerticesOnTheTrueSurfaceAndOneBelow) {
  const TriangleMesh mesh =
      make_object({.kind = Kind::sphere, .radius_m = 0.01, .edge_m = 2e-4, .fine_radius_m = 0.001}, "");
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v) {
    const Vector3 x = mesh.positions.row(v);
    EXPECT_NEAR((x - Vector3(0, 0, 0.01)).norm(), 0.01, 1e-15);
  }
  EXPECT_LT(mesh.num_vertices(), 2000);
}

}  // namespace object_shapes_test
}  // namespace tacipc::verify
