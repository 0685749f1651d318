#include "stages/dataset/report/view/scene_view.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "tests/stages/gel/export/pressed_cube.h"

namespace tacipc {
namespace scene_view_test {

using ::testing::ElementsAre;

/// The corners of the cube's front in one order, whatever that of the view.
Positions sorted(Positions x) {
  std::vector<std::array<double, 3>> rows;
  for (Eigen::Index v = 0; v < x.rows(); ++v) rows.push_back({x(v, 0), x(v, 1), x(v, 2)});
  std::sort(rows.begin(), rows.end());
  for (Eigen::Index v = 0; v < x.rows(); ++v)
    for (int c = 0; c < 3; ++c) x(v, c) = rows[static_cast<std::size_t>(v)][static_cast<std::size_t>(c)];
  return x;
}

TEST(SceneView, PressureIsForceIntoTheFaceOverItsDeformedArea) {
  const Positions x{{0, 0, 0}, {2e-3, 0, 0}, {0, 2e-3, 0}};
  const Positions force{{0, 0, -1}, {3, 0, 0}, {0, 0, 1}};
  const Eigen::VectorXd pressure = vertex_pressures(x, Triangles{{0, 1, 2}}, force);
  EXPECT_NEAR(pressure[0], 1.0 / (2e-6 / 3.0), 1e-6);  // a third of 2 mm²
  EXPECT_EQ(pressure[1], 0.0);                         // along the face
  EXPECT_EQ(pressure[2], 0.0);                         // pulls
}

TEST(SceneView, OfManyFramesSomeAreShownFromTheFirstToTheLast) {
  EXPECT_THAT(viewed_frames(1, 1000), ElementsAre(0));
  EXPECT_THAT(viewed_frames(4, 1000), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(viewed_frames(100, 100'000), ElementsAre(0, 33, 66, 99));
  EXPECT_THAT(viewed_frames(9, 1'000'000), ElementsAre(0, 8));
}

TEST(SceneView, EveryGelAndObjectHasItsPoseInTheWorld) {
  const ScratchFolder scratch;
  write_pressed_scene(scratch);
  const SceneFolder scene = read_scene_folder(scratch / "scene");
  const auto view = read_scene_view(scene, scratch / "scene");
  ASSERT_TRUE(view);
  EXPECT_THAT(view->frames, ElementsAre(0, 1));
  ASSERT_EQ(view->gels.size(), 2u);
  EXPECT_EQ(view->gels[0].name, "left");
  EXPECT_EQ(view->gels[1].name, "right");
  const std::vector<Matrix4> fingers = pressed_scene_fingers();
  for (std::size_t g = 0; g < 2; ++g) {
    for (std::size_t f = 0; f < 2; ++f) EXPECT_EQ(view->gels[g].frames[f].world_from_gel, fingers[2 * f + g]);
    EXPECT_TRUE(sorted(view->gels[g].frames[1].positions)
                    .isApprox(Positions{{0, 0, -2e-3}, {0, 1e-2, -2e-3}, {1e-2, 0, -2e-3}, {1e-2, 1e-2, -2e-3}}, 1e-9));
    EXPECT_DOUBLE_EQ(view->gels[g].bottom_m, -0.01);
  }
  ASSERT_EQ(view->objects.size(), 1u);
  EXPECT_EQ(view->objects[0].world_from_object[1](2, 3), -0.003);
  EXPECT_EQ(view->objects[0].mesh.num_triangles(), 4);
  scratch.file("object.ply", "another");
  EXPECT_FALSE(read_scene_view(scene, scratch / "scene"));
}

TEST(SceneView, OfASceneBodiesFollowTheirKind) {
  const ScratchFolder scratch;
  write_pressed_bodies(scratch);
  const auto view = read_scene_view(read_scene_folder(scratch / "bodies"), scratch / "bodies");
  ASSERT_TRUE(view);
  ASSERT_EQ(view->gels.size(), 1u);
  EXPECT_EQ(view->gels[0].name, "pad");
  ASSERT_EQ(view->objects.size(), 3u);
  const ViewedObject &peg = view->objects[0], &wall = view->objects[1], &ball = view->objects[2];
  EXPECT_EQ(peg.world_from_object[1](2, 3), -0.003);
  EXPECT_FALSE(peg.fixed);
  EXPECT_TRUE(wall.fixed);
  EXPECT_NEAR(wall.mesh.positions.maxCoeff(), 1e-3, 1e-15);
  // The cube's surface without its centre.
  ASSERT_EQ(ball.deformed.size(), 2u);
  EXPECT_EQ(ball.mesh.num_vertices(), 8);
  EXPECT_EQ(ball.mesh.num_triangles(), 12);
  EXPECT_NEAR(signed_volume({ball.deformed[0], ball.mesh.triangles}), 1e-6, 1e-12);
  EXPECT_TRUE(
      (ball.deformed[1] - ball.deformed[0]).isApprox(Positions(Vector3(0, 0, 1e-3).transpose().replicate(8, 1)), 1e-9));
}

TEST(SceneView, OfAPressItsOwnFrameIsTheWorld) {
  const ScratchFolder scratch;
  write_pressed_cube(scratch);
  const auto view = read_press_view(scratch / "press");
  ASSERT_TRUE(view);
  ASSERT_EQ(view->gels.size(), 1u);
  for (const ViewedFront& frame : view->gels[0].frames) EXPECT_EQ(frame.world_from_gel, Matrix4::Identity());
  EXPECT_EQ(view->objects[0].world_from_object[1](0, 3), 1.0);
}

TEST(SceneView, TheImagesThatThereAreAreLinkedFromThePage) {
  const ScratchFolder scratch;
  SceneView view{.frames = {0, 12}, .gels = {{}, {}}, .objects = {}};
  scratch.file("one/right/render/frame_0012/tactile.png", "picture");
  link_pictures(view, {scratch / "one/left/render", scratch / "one/right/render"}, scratch / "one/report");
  EXPECT_THAT(view.gels[0].pictures, ElementsAre("", ""));
  EXPECT_THAT(view.gels[1].pictures, ElementsAre("", "../right/render/frame_0012/tactile.png"));
}

}  // namespace scene_view_test
}  // namespace tacipc
