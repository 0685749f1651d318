#include "common/sample/scene_folder.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/format/npy.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace scene_folder_test {

class SceneFolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    scratch_.file("press.yaml", "stage: press\n");
    write_npy(scratch_ / "time.npy", {2}, std::vector<double>{0.0, 0.25}.data());
    write_poses("object_world_pose.npy", {2, 4, 4}, {1, 2});
    write_poses("finger_pose.npy", {2, 2, 4, 4}, {10, 20, 30, 40});
  }
  /// Poses that are moved along x, one after the other.
  void write_poses(const std::string& file, const std::vector<std::size_t>& shape, const std::vector<double>& along_x) {
    std::vector<double> values;
    for (const double x : along_x) values.insert(values.end(), {1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    write_npy(scratch_ / file, shape, values.data());
  }
  std::string error() const {
    return message_of<DataError>([&] { read_scene_folder(scratch_ / ""); });
  }

  ScratchFolder scratch_;
};

TEST_F(SceneFolderTest, EachGelAndObjectHasItsPoseInEveryFrame) {
  EXPECT_TRUE(is_scene_folder(scratch_ / ""));
  const SceneFolder scene = read_scene_folder(scratch_ / "");
  EXPECT_THAT(scene.times_s, ::testing::ElementsAre(0.0, 0.25));
  ASSERT_EQ(scene.gels.size(), 2u);
  EXPECT_EQ(scene.gels[0].name, "left");
  EXPECT_EQ(scene.gels[1].press(), scratch_ / "right/press");
  EXPECT_EQ(scene.gels[0].world_from_gel[1](0, 3), 30);
  EXPECT_EQ(scene.gels[1].world_from_gel[1](0, 3), 40);
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].world_from_object[1](0, 3), 2);
}

TEST_F(SceneFolderTest, BodiesOfASceneAreSortedByWhatTheyAre) {
  std::filesystem::remove(scratch_ / "finger_pose.npy");
  scratch_.file(
      "press.yaml",
      "stage: press\nsummary:\n  bodies:\n    - {name: pad, kind: gel}\n    - {name: ball, kind: soft}\n    - "
      "{name: peg, kind: rigid, metres_per_unit: 0.001, mass_kg: 0.1}\n    - {name: wall, kind: fixed, "
      "metres_per_unit: 1}\n");
  write_poses("body_pose.npy", {2, 4, 4, 4}, {1, 2, 3, 4, 5, 6, 7, 8});
  std::vector<double> wrenches(2 * 4 * 4 * 6, 0.0);
  wrenches[((1 * 4 + 2) * 4 + 3) * 6 + 2] = 7.0;  // frame 1, on the peg by the wall, z
  write_npy(scratch_ / "pair_wrench.npy", {2, 4, 4, 6}, wrenches.data());
  std::vector<double> energies(16, 0.0);
  energies[8 + 4] = 0.5;
  write_npy(scratch_ / "energy.npy", {2, 8}, energies.data());
  scratch_.file("soft/ball/none", "");
  write_npy(scratch_ / "soft/ball/world_positions.npy", {2, 1, 3}, std::vector<double>{1, 2, 3, 4, 5, 6}.data());
  ASSERT_TRUE(is_scene_folder(scratch_ / ""));
  const SceneFolder scene = read_scene_folder(scratch_ / "");
  ASSERT_EQ(scene.gels.size(), 1u);
  EXPECT_EQ(scene.gels[0].press(), scratch_ / "gels/pad/press");
  EXPECT_EQ(scene.gels[0].world_from_gel[1](0, 3), 5);
  ASSERT_EQ(scene.soft.size(), 1u);
  EXPECT_EQ(scene.soft[0].input, "body_ball");
  EXPECT_EQ(scene.soft[0].positions(2, 1)[1](0, 2), 6);
  EXPECT_THAT(message_of<DataError>([&] { scene.soft[0].positions(2, 3); }), ::testing::HasSubstr("(2, 1, 3)"));
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].name, "peg");
  EXPECT_EQ(scene.objects[0].metres_per_unit, 1e-3);
  EXPECT_EQ(scene.objects[0].world_from_object[1](0, 3), 7);
  EXPECT_FALSE(scene.objects[0].fixed);
  EXPECT_TRUE(scene.objects[1].fixed);
  const SceneBodies forces = read_scene_bodies(scratch_ / "");
  EXPECT_THAT(forces.bodies, ::testing::ElementsAre("pad", "ball", "peg", "wall"));
  EXPECT_EQ(forces.per_frame[1][2 * 4 + 3].force_n.z(), 7.0);
  EXPECT_EQ(forces.energy_j[1][4], 0.5);
  EXPECT_EQ(forces.body_pose[0][3](0, 3), 4);
  write_poses("body_pose.npy", {2, 3, 4, 4}, {1, 2, 3, 4, 5, 6});
  EXPECT_THAT(error(), ::testing::HasSubstr("has the shape (2, 3, 4, 4), expected (2, 4, 4, 4)"));
}

TEST_F(SceneFolderTest, WhatIsNotOneSceneIsRefused) {
  write_poses("finger_pose.npy", {3, 2, 4, 4}, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(error(), (scratch_ / "finger_pose.npy").string() + ": has the shape (3, 2, 4, 4), expected (2, 2, 4, 4)");
  std::filesystem::remove(scratch_ / "finger_pose.npy");
  EXPECT_FALSE(is_scene_folder(scratch_ / ""));
  std::filesystem::remove(scratch_ / "press.yaml");
  EXPECT_EQ(error(), (scratch_ / "").string() + ": has no press.yaml, so the press did not finish");
}

TEST_F(SceneFolderTest, AnArrayThatIsNotTheOneOfTheRecordIsRefused) {
  const std::filesystem::path fingers = scratch_ / "finger_pose.npy";
  scratch_.file("press.yaml", "stage: press\noutputs:\n  finger_pose.npy: " + content_hash(fingers) + "\n");
  EXPECT_EQ(read_scene_folder(scratch_ / "").gels.size(), 2u);
  write_poses("finger_pose.npy", {2, 2, 4, 4}, {10, 20, 30, 41});
  EXPECT_EQ(error(), fingers.string() + ": has changed since press.yaml was written beside it");
}

TEST_F(SceneFolderTest, AGraspWithTheFormerNamesOfItsArraysIsRefused) {
  std::filesystem::rename(scratch_ / "object_world_pose.npy", scratch_ / "object_pose.npy");
  EXPECT_THAT(error(), ::testing::HasSubstr("object_world_pose.npy"));
}

}  // namespace scene_folder_test
}  // namespace tacipc
