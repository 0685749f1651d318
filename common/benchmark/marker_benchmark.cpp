#include "common/benchmark/marker_benchmark.h"

#include <algorithm>

#include "common/benchmark/benchmark_cases.h"

namespace tacipc {
namespace {

MarkerVariant read_variant(ConfigReader& in, const MarkerAssumptions& base) {
  MarkerVariant variant{.name = in.file_name("name"), .assumed = base};
  if (const auto radius = in.optional_number("ball_radius_mm", Range::positive()))
    variant.assumed.ball_radius_m = 1e-3 * *radius;
  if (const auto friction = in.optional_number("friction", Range::non_negative())) variant.assumed.friction = *friction;
  if (const auto scale = in.optional_number("px_per_mm", Range::positive())) variant.assumed.px_per_m = 1e3 * *scale;
  if (in.has("contact_px")) variant.assumed.contact_px = pair_of(in, "contact_px");
  if (const auto thickness = in.optional_number("gel_thickness_mm", Range::positive()))
    variant.gel_thickness_m = 1e-3 * *thickness;
  variant.own_runs = in.has("ball_radius_mm") || in.has("friction") || in.has("gel_thickness_mm");
  return variant;
}

}  // namespace

MarkerBenchmark MarkerBenchmark::read(ConfigReader& in) {
  MarkerBenchmark out;
  out.title = plain(in, "title");
  out.data = plain(in, "data");
  ConfigReader fields = in.section("fields");
  out.press_file = plain(fields, "press");
  out.shear_file = plain(fields, "shear");
  out.remove_press_median = fields.flag("remove_press_median");
  out.remove_shear_median = fields.flag("remove_shear_median");
  out.image_px = pair_of(fields, "image_px");
  out.assumed.px_per_m = 1e3 * fields.number("px_per_mm", Range::positive());
  out.assumed.contact_px = pair_of(fields, "contact_px");
  out.shear_marker_px = pair_of(fields, "shear_marker_px");
  out.least_length_px = fields.number("least_length_px", Range::positive());
  ConfigReader ball = in.section("ball");
  out.assumed.ball_radius_m = 1e-3 * ball.number("radius_mm", Range::positive());
  out.ball_edge_m = 1e-3 * ball.number("edge_mm", Range::positive());
  out.assumed.friction = in.number("friction", Range::non_negative());
  out.sensor = plain(in, "sensor");
  out.mesh = plain(in, "mesh");
  out.press = plain(in, "press");
  ConfigReader runs = in.section("runs");
  out.shallowest_m = 1e-3 * runs.number("shallowest_mm", Range::positive());
  out.deepest_m = 1e-3 * runs.number("deepest_mm", Range{.low = 1e3 * out.shallowest_m, .open_low = true});
  out.depths = runs.integer("depths", 2, 100);
  out.press_step_m = 1e-3 * runs.number("press_step_mm", Range::positive());
  out.shear_m = 1e-3 * runs.number("shear_mm", Range::positive());
  out.shear_steps = runs.integer("shear_steps", 1, 10000);
  out.direction_deg = runs.number("direction_deg");
  for (ConfigReader& item : in.sections("variants")) {
    const MarkerVariant variant = read_variant(item, out.assumed);
    if (variant.name == "base" ||
        std::ranges::any_of(out.variants, [&](const MarkerVariant& v) { return v.name == variant.name; }))
      item.fault("name", "is given twice");
    out.variants.push_back(variant);
  }
  return out;
}

std::vector<double> MarkerBenchmark::depths_m() const {
  std::vector<double> depths_m;
  for (int i = 0; i < depths; ++i)
    depths_m.push_back(shallowest_m + (deepest_m - shallowest_m) * i / static_cast<double>(depths - 1));
  return depths_m;
}

}  // namespace tacipc
