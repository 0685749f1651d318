#include "stages/dataset/report/stage_log.h"

#include <gtest/gtest.h>

#include "tests/scratch_folder.h"

namespace tacipc {
namespace stage_log_test {

constexpr const char* kLog =
    "2024-06-07 12:34:56.789 info: frame 1/2: error: not an error\n"
    "2024-06-07 12:34:57.000 warning: LED 3 lights nothing the camera sees\n"
    "2024-06-07 12:34:58.000 error: press: error: the first\n"
    "2024-06-07 12:34:59.000 error: press: error: frame 3: Newton did not converge\n"
    "  (residual 2.1e-3 m/s > 1e-4,\n"
    "\n"
    "   step 1.2e-7)\n"
    "2024-06-07 12:35:00.000 debug: wall_s: 1.00\n"
    "not part of it\n";

TEST(StageLog, KeepsMessagesOfOneLevelWithTheirFurtherLines) {
  const ScratchFolder scratch;
  const auto log = scratch.file("press.log", kLog);
  EXPECT_EQ(log_messages(log, "error"),
            (std::vector<std::string>{"press: error: the first",
                                      "press: error: frame 3: Newton did not converge (residual 2.1e-3 m/s > 1e-4, "
                                      "step 1.2e-7)"}));
  EXPECT_EQ(log_messages(log, "warning"), (std::vector<std::string>{"LED 3 lights nothing the camera sees"}));
  EXPECT_TRUE(log_messages(scratch / "none.log", "error").empty());
}

TEST(StageLog, TheReasonIsTheLastError) {
  const ScratchFolder scratch;
  scratch.file("press/press.log", kLog);
  EXPECT_EQ(failure_reason(scratch / "press", "press"),
            "press: frame 3: Newton did not converge (residual 2.1e-3 m/s > 1e-4, step 1.2e-7)");
}

TEST(StageLog, SaysWhenThereWasNoChanceToWriteOne) {
  const ScratchFolder scratch;
  EXPECT_EQ(failure_reason(scratch / "press", "press"), "press did not run");
  scratch.file("press/press.log", "2024-06-07 12:34:56.789 info: frame 1/2\n");
  EXPECT_EQ(failure_reason(scratch / "press", "press"), "press ended before it was done, without an error message");
}

TEST(StageLog, ConfigurationFaultsHaveNoStageInFront) {
  const ScratchFolder scratch;
  scratch.file("press/press.log", "2024-06-07 12:34:56.789 error: a.yaml:3:1: depth_mm: missing\n");
  EXPECT_EQ(failure_reason(scratch / "press", "press"), "press: a.yaml:3:1: depth_mm: missing");
}

}  // namespace stage_log_test
}  // namespace tacipc
