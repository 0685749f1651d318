#include "stages/dataset/report/view/scene_view.h"

#include <gmock/gmock.h>

#include "tests/stages/dataset/report/robot_scene.h"

namespace tacipc {
namespace scene_view_robot_test {

class RobotViewTest : public ::testing::Test {
 protected:
  /// Objects of the view that the robot adds.
  std::vector<ViewedObject> added() {
    const SceneFolder scene = read_scene_folder(scratch_ / "bodies");
    SceneView view = *read_scene_view(scene, scratch_ / "bodies");
    const auto had = static_cast<std::ptrdiff_t>(view.objects.size());
    add_robot(view, robot_, scratch_ / "bodies/robot", scene);
    return {view.objects.begin() + had, view.objects.end()};
  }
  void SetUp() override {
    write_robot_scene(scratch_);
    robot_ = read_robot_folder(scratch_ / "bodies/robot");
  }

  ScratchFolder scratch_;
  RobotFolder robot_;
};

TEST_F(RobotViewTest, ShapesThatTheSceneHasNotAreAddedAtTheirPoses) {
  robot_.frames[1].body_pose[0](0, 3) = 0.02;
  const std::vector<ViewedObject> objects = added();
  ASSERT_EQ(objects.size(), 2u);  // the peg is the scene's
  EXPECT_EQ(objects[0].name, "world");
  EXPECT_TRUE(objects[0].fixed);
  EXPECT_FALSE(objects[0].robot);
  EXPECT_EQ(objects[1].name, "arm");
  EXPECT_TRUE(objects[1].robot);
  EXPECT_EQ(objects[1].world_from_object[0](0, 3), 0.0);
  EXPECT_EQ(objects[1].world_from_object[1](0, 3), 0.02);
}

TEST_F(RobotViewTest, WhatCarriesAGelEndsBehindIt) {
  const std::vector<ViewedObject> objects = added();
  // The two corners in front of the gel's face go back to its bottom, those behind stay.
  EXPECT_TRUE(objects[1].mesh.positions.isApprox(
      Positions{{0, 0, -0.01}, {1e-2, 0, -0.01}, {0, 1e-2, -0.02}, {0, 0, -0.02}}, 1e-12));
  EXPECT_NEAR(objects[0].mesh.positions(0, 2), 1e-4, 1e-12);
}

TEST_F(RobotViewTest, WhatMovesAgainstTheGelKeepsItsShape) {
  robot_.frames[1].body_pose[0](0, 3) = 0.02;
  EXPECT_NEAR(added()[1].mesh.positions(0, 2), 1e-4, 1e-12);
}

}  // namespace scene_view_robot_test
}  // namespace tacipc
