// configs/metrics/*.yaml
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config.h"
#include "stages/metrics/ssim.h"

namespace tacipc {

/// Where the contact is, for the images whose name begins so.
struct NamedBox {
  std::string starts_with;  // empty: every image
  Box px;
};

struct MetricsConfig {
  std::string ends_with = ".png";
  std::optional<Box> crop_px;        // cut out and evaluated beside the whole image
  std::vector<NamedBox> boxes = {};  // evaluated within the whole image; the first that fits a name counts
  bool offset_outside_box = false;   // each image gets one offset per channel first, fitted outside its box

  static MetricsConfig read(ConfigReader& in);
  const Box* box_of(const std::string& name) const;
};

}  // namespace tacipc
