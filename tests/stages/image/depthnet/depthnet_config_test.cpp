#include "stages/image/depthnet/depthnet_config.h"

#include <gmock/gmock.h>

#include "tests/stages/image/depthnet/dents.h"

namespace tacipc {
namespace depthnet_config_test {

TEST(DepthnetConfig, DefaultIsReadAndFaultsAreNamed) {
  const auto config =
      read_config<DepthnetConfig>(std::filesystem::path(TACIPC_SOURCE_DIR) / "configs/depthnet/default.yaml");
  EXPECT_EQ(config.network.levels, 4);
  std::string text = kSmall;
  text.replace(text.find("mae"), 3, "mab");
  text.replace(text.find("epochs: 25"), 10, "epochs: 0");
  text.replace(text.find("levels: 2"), 9, "levels: 9");
  EXPECT_THAT(faults_in<DepthnetConfig>(text, "a.yaml"),
              testing::ElementsAre(testing::HasSubstr("network.levels"), testing::HasSubstr("loss.kind"),
                                   testing::HasSubstr("schedule.epochs")));
  text = kSmall;
  text.replace(text.find("warmup_epochs: 1"), 16, "warmup_epochs: 26");
  EXPECT_THAT(faults_in<DepthnetConfig>(text, "a.yaml"),
              testing::ElementsAre(testing::HasSubstr("schedule.warmup_epochs: is longer than the training")));
}

}  // namespace depthnet_config_test
}  // namespace tacipc
