// Content of configs/metrics/*.yaml.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/benchmark/depth_error.h"
#include "common/config/config.h"
#include "stages/study/metrics/ssim.h"

namespace tacipc {

/// Contact box for the images whose name begins with a text.
struct NamedBox {
  std::string starts_with;  // beginning of the name; empty: every image
  Box px;
};

/// Measurements on tactile images.
struct ImageMetrics {
  std::optional<Box> crop_px = {};   // part that is cut out and evaluated, in addition to the whole image
  std::vector<NamedBox> boxes = {};  // boxes evaluated within the whole image; the first that fits a name counts
  bool offset_outside_box = false;   // correct each image by one offset per channel first, fitted outside its box

  static ImageMetrics read(ConfigReader& in);
  const Box* box_of(const std::string& name) const;
};

/// Measurements on depth maps.
struct DepthMetrics {
  DepthRegions regions;

  static DepthMetrics read(ConfigReader& in);
};

/// Configuration of metrics, of one of two kinds.
struct MetricsConfig {
  std::string ends_with;  // ending of the names in folders that count
  std::variant<ImageMetrics, DepthMetrics> what;

  static MetricsConfig read(ConfigReader& in);
};

}  // namespace tacipc
