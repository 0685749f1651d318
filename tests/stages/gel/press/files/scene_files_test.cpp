#include "stages/gel/press/files/scene_files.h"

#include <gmock/gmock.h>

namespace tacipc {
namespace scene_files_test {

using ::testing::ElementsAre;

/// A scene whose frames another run has solved must have the same motion frame by frame, however long it goes on.
TEST(SceneFiles, TheMotionOfAFrameIsThatOfAnotherSceneWhereverBothMoveAlike) {
  const auto motion = [](double way_m, std::vector<int> hold, Vector3 load_n) {
    SceneSpec spec;
    spec.motion = {{.steps = 2, .substeps = 3, .move = {{.body = 0, .way = {.shift_m = {0, 0, way_m}}}}, .hold = hold},
                   {.steps = 1, .load_n = {{1, load_n}}}};
    return motion_by_frame(spec);
  };
  const auto usual = motion(1e-3, {1}, {0, 0, -1});
  EXPECT_THAT(usual, ElementsAre("\n", "frame 1 of a phase; 3 steps; move 0 0 0 0.0005 0 0 0; hold 1\n",
                                 "frame 2 of a phase; 3 steps; move 0 0 0 0.001 0 0 0; hold 1\n",
                                 "frame 1 of a phase; 1 steps; load 1 0 0 -1\n"));
  const auto farther = motion(2e-3, {1}, {0, 0, -1}), free = motion(1e-3, {}, {0, 0, -1}),
             loaded = motion(1e-3, {1}, {0, 0, -2});
  EXPECT_NE(farther[1], usual[1]);
  EXPECT_NE(free[1], usual[1]);
  EXPECT_EQ(loaded[2], usual[2]);
  EXPECT_NE(loaded[3], usual[3]);
}

}  // namespace scene_files_test
}  // namespace tacipc
