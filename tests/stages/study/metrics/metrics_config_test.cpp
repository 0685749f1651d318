#include "stages/study/metrics/metrics_config.h"

#include <gmock/gmock.h>

#include "tests/config_text.h"

namespace tacipc {
namespace metrics_config_test {

TEST(MetricsConfig, TheKindTellsTheFilesAndTheKeys) {
  const auto images = config_from_text<MetricsConfig>("{kind: images}", "m.yaml"),
             depth = config_from_text<MetricsConfig>("{kind: depth, pressed_mm: 0.02}", "m.yaml");
  EXPECT_EQ(images.ends_with, ".png");
  EXPECT_TRUE(std::holds_alternative<ImageMetrics>(images.what));
  EXPECT_EQ(depth.ends_with, ".exr");
  EXPECT_DOUBLE_EQ(std::get<DepthMetrics>(depth.what).regions.pressed_m, 0.02e-3);
  EXPECT_THAT(faults_in<MetricsConfig>("{kind: depth, crop_px: [0, 0, 20, 20]}", "m.yaml"),
              testing::ElementsAre("m.yaml:1:1: pressed_mm: missing", "m.yaml:1:15: crop_px: unknown key"));
}

}  // namespace metrics_config_test
}  // namespace tacipc
