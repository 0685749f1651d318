#include "stages/image/depthnet/outcome_config.h"

#include <gmock/gmock.h>

#include "tests/stages/image/depthnet/dents.h"
#include "tests/stages/image/depthnet/grasps.h"

namespace tacipc {
namespace outcome_config_test {

TEST(TaskConfig, IsOfDepthUnlessItSaysOutcome) {
  EXPECT_TRUE(std::holds_alternative<DepthnetConfig>(config_from_text<TaskConfig>(kSmall, "a.yaml").task));
  EXPECT_EQ(small_outcome().seeds, 2);
  const auto shipped =
      read_config<TaskConfig>(std::filesystem::path(TACIPC_SOURCE_DIR) / "configs/depthnet/outcome.yaml");
  EXPECT_EQ(std::get<OutcomeConfig>(shipped.task).seeds, 5);
  std::string text = kSmallOutcome;
  text.replace(text.find("hidden: 8"), 9, "hidden: 0");
  text += "loss: {kind: mae}\n";
  EXPECT_THAT(faults_in<TaskConfig>(text, "a.yaml"),
              testing::ElementsAre(testing::HasSubstr("hidden"), testing::HasSubstr("loss")));
}

}  // namespace outcome_config_test
}  // namespace tacipc
