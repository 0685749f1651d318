#include "stages/image/calibrate/calibrate_config.h"

#include "common/base/units.h"

namespace tacipc {

CalibrateConfig CalibrateConfig::read(ConfigReader& in) {
  CalibrateConfig config;
  LightGeometry& geometry = config.geometry;
  config.ball_radius_m = 1e-3 * in.number("ball_radius_mm", Range::positive());
  config.contact_gap_m = 1e-3 * in.number("contact_gap_mm", Range::positive());
  config.label_sigma_px = in.number("label_sigma_px", Range::non_negative());
  config.fit_contact_gap = in.flag_or("fit_contact_gap", false);
  if (config.fit_contact_gap && config.label_sigma_px == 0.0)
    in.fault("fit_contact_gap", "needs balls that are fitted: label_sigma_px above 0");
  config.fit_radius_px = in.number("fit_radius_px", Range::positive());
  config.fit_stride_px = in.integer("fit_stride_px", 1, 100);
  config.drift_radius_px = in.number("drift_radius_px", Range::positive());
  config.object_margin_px = in.integer_or("object_margin_px", 0, 0, 10000);
  for (ConfigReader& item : in.sections("lamps")) {
    config.lamps.push_back(
        {.azimuth_rad = item.number("azimuth_deg") * kDegree,
         .distance_m = 1e-3 * item.number("distance_mm", Range::positive()),
         .elevation_tan = item.number("elevation_tan", Range::positive()),
         .half_width_rad = kDegree * item.number_or("half_width_deg", 0.0, Range::between(0.0, 90.0))});
  }
  if (auto bounds = in.optional_section("lamp_bounds")) {
    config.bounds.azimuth_rad = bounds->number("azimuth_deg", Range::between(0.0, 180.0)) * kDegree;
    const auto elevation = bounds->numbers("elevation_tan", 2, Range::positive());
    const auto distance = bounds->numbers("distance_mm", 2, Range::positive());
    if (elevation[0] > elevation[1]) bounds->fault("elevation_tan", "expected [least, largest]");
    if (distance[0] > distance[1]) bounds->fault("distance_mm", "expected [least, largest]");
    const auto width = bounds->numbers_or("half_width_deg", {0.0, 0.0}, Range::between(0.0, 90.0));
    if (width[0] > width[1]) bounds->fault("half_width_deg", "expected [least, largest]");
    config.bounds.half_width_rad = {kDegree * width[0], kDegree * width[1]};
    config.bounds.elevation_tan = {elevation[0], elevation[1]};
    config.bounds.distance_m = {1e-3 * distance[0], 1e-3 * distance[1]};
  } else if (!config.lamps.empty()) {
    in.fault("lamp_bounds", "needed where there are lamps");
  }
  for (const LampGuess& lamp : config.lamps) {
    const auto inside = [](double value, const std::array<double, 2>& range) {
      return value >= range[0] && value <= range[1];
    };
    const bool free_width = config.bounds.half_width_rad[1] > config.bounds.half_width_rad[0];
    if (inside(lamp.elevation_tan, config.bounds.elevation_tan) && inside(lamp.distance_m, config.bounds.distance_m) &&
        (!free_width || inside(lamp.half_width_rad, config.bounds.half_width_rad)))
      continue;
    in.fault("lamps", "a lamp starts outside lamp_bounds");
    break;
  }
  config.fit_lamps = in.flag_or("fit_lamps", true);
  geometry.environment_degree = in.integer("environment_degree", 0, 8);
  geometry.environment_depth = in.flag_or("environment_depth", false);
  if (auto dome = in.optional_section("dome")) geometry.dome = read_dome_bins(*dome);
  const bool environment = geometry.environment_degree > 0 || geometry.dome.size() > 0;
  if (geometry.environment_depth && !environment)
    in.fault("environment_depth", "without environment_degree or dome there is no environment");
  geometry.field_degree = in.integer_or("field_degree", 1, 0, 4);
  if (config.lamps.empty() && !environment)
    in.fault("environment_degree", "without lamps there must be an environment");
  geometry.shadow_softness = in.number("shadow_softness", Range::positive());
  config.blur_px = in.number("blur_px", Range::between(0.0, 100.0));
  config.relief_slope = in.number_or("relief_slope", 0.0, Range::between(0.0, 1.0));
  config.ridge = in.number("ridge", Range::non_negative());
  config.folds = in.integer("folds", 2, 1000);
  return config;
}

}  // namespace tacipc
