#include "stages/image/calibrate/sensor_fit_config.h"

namespace tacipc {

const std::vector<std::string>& parameter_names() {
  static const std::vector<std::string> names = {"ring_radius_mm",
                                                 "ring_z_mm",
                                                 "ring_azimuth_deg",
                                                 "ring_tilt_deg",
                                                 "list_x_mm",
                                                 "list_y_mm",
                                                 "list_z_mm",
                                                 "list_scale",
                                                 "list_azimuth_deg",
                                                 "emission_exponent",
                                                 "camera_x_mm",
                                                 "camera_y_mm",
                                                 "camera_z_mm",
                                                 "camera_rotation_x_deg",
                                                 "camera_rotation_y_deg",
                                                 "camera_rotation_z_deg",
                                                 "window_scale",
                                                 "vignetting_v2",
                                                 "vignetting_v4",
                                                 "gamma",
                                                 "specular_f0",
                                                 "ggx_alpha"};
  return names;
}

SensorFitConfig SensorFitConfig::read(ConfigReader& file) {
  ConfigReader in = file.section("sensor_fit");
  SensorFitConfig config;
  config.block_px = in.integer("block_px", 1, 256);
  config.sigma_codes = in.number("sigma_codes", Range::positive());
  config.subpixels = in.integer_or("subpixels", config.subpixels, 1, 16);
  config.led_samples = in.integer_or("led_samples", config.led_samples, 1, 16);
  ConfigReader parameters = in.section("parameters");
  for (const std::string& name : parameter_names()) {
    auto item = parameters.optional_section(name);
    if (!item) continue;
    FreeParameter parameter{.name = name, .sigma = item->number("sigma", Range::positive())};
    parameter.mean = item->optional_number("mean");
    if (item->has("bounds")) {
      const auto bounds = item->numbers("bounds", 2);
      if (bounds[0] >= bounds[1]) item->fault("bounds", "expected [least, largest]");
      parameter.bounds = {bounds[0], bounds[1]};
    }
    config.parameters.push_back(std::move(parameter));
  }
  if (auto balls = in.optional_section("balls")) {
    config.balls = FitBalls{.radius_m = 1e-3 * balls->number("radius_mm", Range::positive()),
                            .contact_gap_m = 1e-3 * balls->number("contact_gap_mm", Range::positive()),
                            .label_sigma_px = balls->number("label_sigma_px", Range::non_negative()),
                            .fit_radius_px = balls->optional_number("fit_radius_px", Range::positive())};
  }
  return config;
}

}  // namespace tacipc
