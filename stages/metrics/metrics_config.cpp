#include "stages/metrics/metrics_config.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "stages/metrics/metrics_table.h"

namespace tacipc {

MetricsConfig MetricsConfig::read(ConfigReader& in) {
  MetricsConfig config;
  config.ends_with = in.text_or("ends_with", config.ends_with);
  if (!in.has("crop_px")) return config;
  constexpr double kWidest = 1e6;
  const auto box = in.numbers("crop_px", 4, Range::between(0.0, kWidest));
  for (const double value : box) {
    if (value == std::round(value)) continue;
    in.fault("crop_px", "expected whole pixels");
    break;
  }
  if (std::min(box[2], box[3]) < kLeastSide)
    in.fault("crop_px", fmt::format("must be at least {} pixels wide and high", kLeastSide));
  config.crop_px =
      Box{static_cast<int>(box[0]), static_cast<int>(box[1]), static_cast<int>(box[2]), static_cast<int>(box[3])};
  return config;
}

}  // namespace tacipc
