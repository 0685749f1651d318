#include "common/sample/sample_status.h"

#include <gtest/gtest.h>

#include "common/base/files.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace sample_status_test {

TEST(SampleStatus, AFingerIsAFolderOfAGraspNotAnySampleOfThatName) {
  const ScratchFolder scratch;
  const std::filesystem::path grasp = scratch / "grasp", own = scratch / "left", planned = scratch / "right";
  for (const auto& folder : {grasp / "left/press", grasp / "right/press", own / "press", planned})
    std::filesystem::create_directories(folder);
  write_file(grasp / "press.log", "");
  EXPECT_TRUE(is_finger(grasp / "left"));
  EXPECT_TRUE(is_finger(grasp / "right"));
  EXPECT_FALSE(is_finger(grasp));
  EXPECT_EQ(stage_file(grasp / "left", "press", ".log"), grasp / "press.log");
  // Samples that someone calls so.
  write_file(own / "press/press.log", "");
  write_file(planned / "sample.yaml", "");
  EXPECT_FALSE(is_finger(own));
  EXPECT_FALSE(is_finger(planned));
  EXPECT_EQ(stage_file(own, "press", ".log"), own / "press/press.log");
  std::filesystem::create_directories(planned / "press");
  write_file(planned / "press/press.timings.yaml", "");
  EXPECT_EQ(timings_file(planned, "press"), planned / "press/press.timings.yaml");
}

}  // namespace sample_status_test
}  // namespace tacipc
