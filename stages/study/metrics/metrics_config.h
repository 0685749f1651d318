// configs/metrics/*.yaml
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/benchmark/depth_error.h"
#include "common/config/config.h"
#include "stages/study/metrics/ssim.h"

namespace tacipc {

/// Where the contact is, for the images whose name begins so.
struct NamedBox {
  std::string starts_with;  // empty: every image
  Box px;
};

/// What to measure of tactile images.
struct ImageMetrics {
  std::optional<Box> crop_px = {};   // cut out and evaluated beside the whole image
  std::vector<NamedBox> boxes = {};  // evaluated within the whole image; the first that fits a name counts
  bool offset_outside_box = false;   // each image gets one offset per channel first, fitted outside its box

  static ImageMetrics read(ConfigReader& in);
  const Box* box_of(const std::string& name) const;
};

/// What to measure of depth maps.
struct DepthMetrics {
  DepthRegions regions;

  static DepthMetrics read(ConfigReader& in);
};

struct MetricsConfig {
  std::string ends_with;  // of the names in folders that count
  std::variant<ImageMetrics, DepthMetrics> what;

  static MetricsConfig read(ConfigReader& in);
};

}  // namespace tacipc
