// configs/metrics/*.yaml
#pragma once

#include <optional>
#include <string>

#include "common/config.h"

namespace tacipc {

struct Box {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

struct MetricsConfig {
  std::string ends_with = ".png";
  std::optional<Box> crop_px;  // evaluated beside the whole image

  static MetricsConfig read(ConfigReader& in);
};

}  // namespace tacipc
