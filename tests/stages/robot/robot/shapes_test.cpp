#include "stages/robot/robot/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/mesh/mass_properties.h"
#include "tests/stages/robot/robot/small_robots.h"

namespace tacipc {
namespace shapes_test {

using std::numbers::pi;

/// Of a body with these geoms, and of no other.
TriangleMesh shape_of(const std::string& geoms, const std::string& sections = "") {
  const ScratchFolder folder;
  const TaskSpec task = written_task(
      folder,
      mjcf(kPlate + R"(<body name="b">)" + geoms + R"(<geom name="pad" size="0.01" group="4"/></body>)", sections),
      "pads: {name: gel, geom: pad}\n" + kPlateObject + "steps: {seconds: 1}\n");
  const RobotModel robot(task, {{}}, false);
  return shape_of_body(robot.model(), robot.id(mjOBJ_BODY, "b"));
}

/// Its facets enclose a volume, looking outwards; mass_properties refuses what looks inwards.
void expect_solid(const TriangleMesh& shape, double volume_m3, double relative, const Vector3& center_m) {
  const MassProperties mass = mass_properties(shape.positions, shape.triangles);
  EXPECT_NEAR(mass.volume_m3, volume_m3, relative * volume_m3);
  EXPECT_LE(mass.volume_m3, volume_m3 * (1.0 + 1e-6));  // facets lie within
  EXPECT_LT((mass.center_m - center_m).norm(), 1e-6);
}

// Area of 24 facets around in that of the circle, and what six rings a quarter leave of a ball.
const double kAround = 12.0 / pi * std::sin(pi / 12.0);

TEST(ShapeOfBody, ABoxIsExact) {
  const TriangleMesh box = shape_of(R"(<geom type="box" size="0.1 0.2 0.3" pos="1 2 3"/>)");
  EXPECT_EQ(box.num_triangles(), 12);
  expect_solid(box, 8 * 0.006, 1e-12, {1, 2, 3});
}

TEST(ShapeOfBody, ACylinderHasItsFacetsVolume) {
  const TriangleMesh shape = shape_of(R"(<geom type="cylinder" size="0.1 0.2"/>)");
  expect_solid(shape, kAround * pi * 0.01 * 0.4, 1e-9, Vector3::Zero());
}

TEST(ShapeOfBody, RoundShapesHaveTheirVolumesWithinTheirFacets) {
  const double ball = 4.0 / 3.0 * pi;
  expect_solid(shape_of(R"(<geom type="sphere" size="0.1"/>)"), ball * 1e-3, 0.03, Vector3::Zero());
  expect_solid(shape_of(R"(<geom type="capsule" size="0.1 0.2"/>)"), ball * 1e-3 + pi * 0.01 * 0.4, 0.03,
               Vector3::Zero());
  expect_solid(shape_of(R"(<geom type="ellipsoid" size="0.1 0.2 0.3" pos="0 1 0"/>)"), ball * 6e-3, 0.03, {0, 1, 0});
}

TEST(ShapeOfBody, ATurnedGeomIsTurned) {
  const TriangleMesh box = shape_of(R"(<geom type="box" size="0.1 0.2 0.3" euler="0 0 90"/>)");
  EXPECT_NEAR(box.positions.col(0).maxCoeff(), 0.2, 1e-12);
  EXPECT_NEAR(box.positions.col(1).maxCoeff(), 0.1, 1e-12);
  expect_solid(box, 8 * 0.006, 1e-12, Vector3::Zero());
}

TEST(ShapeOfBody, AMeshStandsWhereItsFileSays) {
  // MuJoCo keeps it about its own centre and axes.
  const TriangleMesh shape = shape_of(R"(<geom type="mesh" mesh="t" pos="1 0 0"/>)",
                                      R"(<asset><mesh name="t" vertex="0 0 0  0.3 0 0  0 0.1 0  0 0 0.2"/></asset>)");
  expect_solid(shape, 0.3 * 0.1 * 0.2 / 6.0, 1e-6, {1.0 + 0.075, 0.025, 0.05});
}

TEST(ShapeOfBody, SeveralGeomsAreOneAndHiddenOnesAndPlanesAreNone) {
  const TriangleMesh shape =
      shape_of(R"(<geom type="box" size="0.1 0.1 0.1"/><geom type="box" size="0.1 0.1 0.1" pos="1 0 0"/>
    <geom type="box" size="0.1 0.1 0.1" pos="5 0 0" group="3"/>)");
  EXPECT_EQ(shape.num_triangles(), 24);
  expect_solid(shape, 2 * 0.008, 1e-12, {0.5, 0, 0});
  EXPECT_EQ(shape_of("").num_triangles(), 0);
}

}  // namespace shapes_test
}  // namespace tacipc
