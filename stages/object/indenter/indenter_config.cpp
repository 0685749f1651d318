#include "stages/object/indenter/indenter_config.h"

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

IndenterConfig IndenterConfig::read(ConfigReader& in) {
  IndenterConfig config;
  if (auto ball = in.optional_section("ball")) {
    config.ball_radius_m = 1e-3 * ball->number("radius_mm", Range::positive());
    config.ball_edge_m = 1e-3 * ball->number("edge_mm", Range::positive());
    if (config.ball_edge_m > *config.ball_radius_m) ball->fault("edge_mm", "must not exceed the radius");
  }
  if (auto mesh = in.optional_section("mesh")) {
    RoundedMesh wanted;
    wanted.unit = mesh->choice("unit", kLengthUnits);
    wanted.edge_radius_m = 1e-3 * mesh->number("edge_radius_mm", Range::non_negative());
    wanted.spacing_m = 1e-3 * mesh->number("spacing_mm", Range::positive());
    wanted.relief_m = 1e-3 * mesh->number("relief_mm", Range::positive());
    if (wanted.relief_m < 2.0 * wanted.edge_radius_m)
      mesh->fault("relief_mm", "must be at least twice the edge radius");
    config.mesh = wanted;
  }
  if (config.ball_radius_m.has_value() == config.mesh.has_value()) in.fault("ball", "give either ball or mesh");
  return config;
}

}  // namespace tacipc
