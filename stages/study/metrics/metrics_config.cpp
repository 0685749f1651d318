#include "stages/study/metrics/metrics_config.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tacipc {

namespace {

Box read_box(ConfigReader& in, const std::string& key, int least_side) {
  constexpr double kMaxSidePx = 1e6;
  const auto box = in.numbers(key, 4, Range::between(0.0, kMaxSidePx));
  for (const double value : box) {
    if (value == std::round(value)) continue;
    in.fault(key, "expected whole pixels");
    break;
  }
  if (std::min(box[2], box[3]) < least_side)
    in.fault(key, fmt::format("must be at least {} pixel{} wide and high", least_side, least_side > 1 ? "s" : ""));
  return {static_cast<int>(box[0]), static_cast<int>(box[1]), static_cast<int>(box[2]), static_cast<int>(box[3])};
}

}  // namespace

ImageMetrics ImageMetrics::read(ConfigReader& in) {
  ImageMetrics config;
  if (in.has("crop_px")) config.crop_px = read_box(in, "crop_px", kLeastSide);
  for (ConfigReader& item : in.sections("boxes"))
    config.boxes.push_back({.starts_with = item.text_or("starts_with", ""), .px = read_box(item, "px", 1)});
  config.offset_outside_box = in.flag_or("offset_outside_box", false);
  if (config.offset_outside_box && config.boxes.empty()) in.fault("offset_outside_box", "needs boxes");
  return config;
}

const Box* ImageMetrics::box_of(const std::string& name) const {
  for (const NamedBox& box : boxes)
    if (name.starts_with(box.starts_with)) return &box.px;
  return nullptr;
}

DepthMetrics DepthMetrics::read(ConfigReader& in) {
  return {{.pressed_m = 1e-3 * in.number("pressed_mm", Range::positive()),
           .contact_m = 1e-3 * in.number_or("contact_mm", 0.0, Range::non_negative()),
           .beside_px = in.integer_or("beside_px", 0, 0, 10000)}};
}

MetricsConfig MetricsConfig::read(ConfigReader& in) {
  if (in.choice("kind", {"images", "depth"}) == "depth")
    return {.ends_with = in.text_or("ends_with", ".exr"), .what = DepthMetrics::read(in)};
  return {.ends_with = in.text_or("ends_with", ".png"), .what = ImageMetrics::read(in)};
}

}  // namespace tacipc
