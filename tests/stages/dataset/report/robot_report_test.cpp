#include "stages/dataset/report/robot_report.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "tests/stages/dataset/report/robot_scene.h"
#include "tests/stages/dataset/report/sample_folder.h"

namespace tacipc {
namespace robot_report_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

TEST(RobotReport, TellsTaskStepsDrawnValuesAndTries) {
  const ScratchFolder scratch;
  write_robot_scene(scratch);
  const auto robot = read_robot_report(scratch / "bodies");
  ASSERT_TRUE(robot);
  EXPECT_EQ(robot->task, "pick");
  EXPECT_EQ(robot->seed, "7");
  EXPECT_THAT(robot->variables, ElementsAre(Pair("mass_g", 50.0)));
  EXPECT_THAT(robot->steps, ElementsAre("1 grip", "2 move"));
  EXPECT_EQ(robot->tolerance, 0.002);
  ASSERT_EQ(robot->tries.size(), 7u);
  EXPECT_EQ(robot->tries[1].frames, 5);  // came before those of two frames
  EXPECT_EQ(robot->tries[3].window, 2);
  EXPECT_EQ(robot->tries[3].frames, 2);
  EXPECT_EQ(robot->tries[3].residual_relative, 0.05);
  EXPECT_EQ(robot->tries[3].stiffness_n_m, 42000.0);
}

TEST(RobotReport, ASceneWithoutARobotHasNoneAndARobotAloneHasNoTries) {
  const ScratchFolder scratch;
  write_robot_scene(scratch);
  std::filesystem::remove(scratch / "bodies/residuals.csv");
  EXPECT_TRUE(read_robot_report(scratch / "bodies")->tries.empty());
  std::filesystem::remove(scratch / "bodies/robot/robot.yaml");
  EXPECT_FALSE(read_robot_report(scratch / "bodies"));
}

TEST(RobotReport, ATryThatIsNoNumberIsRefusedWithItsPlace) {
  const ScratchFolder scratch;
  write_robot_scene(scratch);
  const auto file = scratch.file("bodies/residuals.csv", replaced(kResiduals, "0.25,41000", "much,41000"));
  EXPECT_EQ(message_of<DataError>([&] { read_robot_report(scratch / "bodies"); }),
            file.string() + ":6: residual_relative: expected a number, found 'much'");
}

}  // namespace robot_report_test
}  // namespace tacipc
