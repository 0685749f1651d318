#include "stages/object/decimate/decimate_config.h"

namespace tacipc {

DecimateConfig DecimateConfig::read(ConfigReader& in) {
  DecimateConfig config;
  config.collapse.target_vertices = in.integer("target_vertices", 4);
  config.collapse.max_normal_change_deg =
      in.number_or("max_normal_change_deg", config.collapse.max_normal_change_deg, Range::between(1.0, 90.0));
  config.collapse.max_aspect_ratio =
      in.number_or("max_aspect_ratio", config.collapse.max_aspect_ratio, Range::between(2.0, 1e6));

  ConfigReader doctor = in.section("doctor");
  config.doctor.min_extent_m = 1e-3 * doctor.number("min_extent_mm", Range::positive());
  config.doctor.max_extent_m = 1e-3 * doctor.number("max_extent_mm", Range::positive());
  config.doctor.relative_weld_distance =
      doctor.number_or("relative_weld_distance", config.doctor.relative_weld_distance, Range::between(0.0, 1e-3));
  config.doctor.max_hole_edges = doctor.integer_or("max_hole_edges", config.doctor.max_hole_edges, 0, 1000);
  config.doctor.relative_max_hole_length =
      doctor.number_or("relative_max_hole_length", config.doctor.relative_max_hole_length, Range::between(0.0, 10.0));
  config.doctor.debris_area_fraction =
      doctor.number_or("debris_area_fraction", config.doctor.debris_area_fraction, Range::between(0.0, 0.5));
  config.doctor.refuse_self_intersections =
      doctor.flag_or("refuse_self_intersections", config.doctor.refuse_self_intersections);
  if (config.doctor.min_extent_m >= config.doctor.max_extent_m)
    doctor.fault("max_extent_mm", "must be larger than min_extent_mm");

  ConfigReader hausdorff = in.section("hausdorff");
  config.hausdorff.spacing_m = 1e-3 * hausdorff.number("spacing_mm", Range::between(1e-4, 100.0));
  config.hausdorff.max_samples =
      hausdorff.integer_or("max_samples", static_cast<int>(config.hausdorff.max_samples), 1000);
  return config;
}

}  // namespace tacipc
