#include "stages/image/track/track_config.h"

namespace tacipc {

TrackConfig TrackConfig::read(ConfigReader& in) {
  TrackConfig config;
  config.curve = in.choice_or("curve", config.curve, {"srgb", "linear"});
  ConfigReader dots = in.section("dots");
  config.least_diameter_px = dots.number("least_diameter_px", Range{.low = 2.0});
  config.most_diameter_px = dots.number("most_diameter_px", Range{.low = config.least_diameter_px, .high = 500.0});
  config.least_contrast =
      dots.number_or("least_contrast", config.least_contrast, Range{.low = 0.0, .high = 1.0, .open_low = true});
  config.most_area_ratio =
      dots.number_or("most_area_ratio", config.most_area_ratio, Range{.low = 1.0, .open_low = true});
  if (auto flow = in.optional_section("flow")) {
    config.flow_window_px = flow->integer_or("window_px", config.flow_window_px, 5, 201);
    config.flow_levels = flow->integer_or("levels", config.flow_levels, 0, 10);
    config.most_return_px = flow->number_or("most_return_px", config.most_return_px, Range::positive());
    config.most_correction_px = flow->number_or("most_correction_px", config.most_correction_px, Range::positive());
  }
  return config;
}

}  // namespace tacipc
