#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stages/study/cases/case_files.h"
#include "stages/study/cases/make_variables.h"

namespace tacipc {
namespace {

std::string depth_name(double depth_m) { return fmt::format("{:04}um", std::lround(1e6 * depth_m)); }

/// Motion: a press at the contact's position in the image, then a sideways motion.
std::string motion(const MarkerBenchmark& benchmark, double depth_m) {
  const Eigen::Vector2d center_mm =
      1e3 * (benchmark.assumed.contact_px - 0.5 * benchmark.image_px) / benchmark.assumed.px_per_m;
  return fmt::format(
      "placement: {{center_mm: [{:.10g}, {:.10g}]}}\nmotion:\n  - {{kind: press, depth_mm: {:.10g}, steps: {}}}\n"
      "  - {{kind: shear, direction_deg: {:.10g}, distance_mm: {:.10g}, steps: {}}}\n",
      center_mm.x(), center_mm.y(), 1e3 * depth_m, std::max(1L, std::lround(depth_m / benchmark.press_step_m)),
      benchmark.direction_deg, 1e3 * benchmark.shear_m, benchmark.shear_steps);
}

}  // namespace

CaseFiles marker_files(const MarkerBenchmark& benchmark, const std::string& folder) {
  CaseFiles files;
  std::string depths, variants = "base";
  for (const double depth_m : benchmark.depths_m()) {
    depths += fmt::format("{}{}", depths.empty() ? "" : " ", depth_name(depth_m));
    files.emplace_back("motion_" + depth_name(depth_m) + ".yaml", motion(benchmark, depth_m));
  }
  const auto simulated = [&](const std::string& name, const MarkerAssumptions& assumed) {
    files.emplace_back(name + "/indenter.yaml", fmt::format("ball: {{radius_mm: {:.10g}, edge_mm: {:.10g}}}\n",
                                                            1e3 * assumed.ball_radius_m, 1e3 * benchmark.ball_edge_m));
    files.emplace_back(
        name + "/friction.yaml",
        assumed.friction > 0.0
            ? fmt::format("friction: {{coefficient: {}, relative_speed_threshold: 1.0e-3, lag: iterated}}\n",
                          assumed.friction)
            : "");
  };
  simulated("base", benchmark.assumed);
  for (const MarkerVariant& variant : benchmark.variants) {
    if (!variant.own_runs) continue;
    variants += " " + variant.name;
    simulated(variant.name, variant.assumed);
  }
  MakeVariables make("MARKERS", folder);
  make.set("PRESSED", benchmark.data + "/" + benchmark.press_file);
  make.set("SHEARED", benchmark.data + "/" + benchmark.shear_file);
  make.set_path("SENSOR", benchmark.sensor);
  make.set_path("MESH", benchmark.mesh);
  make.set_path("PRESS", benchmark.press);
  make.set("DEPTHS", depths);
  make.set("VARIANTS", variants);
  for (const MarkerVariant& variant : benchmark.variants)
    if (variant.gel_thickness_m)
      make.set("THICKNESS_MM_" + variant.name, fmt::format("{:.10g}", 1e3 * *variant.gel_thickness_m));
  files.emplace_back("cases.mk", make.text());
  return files;
}

}  // namespace tacipc
