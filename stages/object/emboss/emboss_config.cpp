#include "stages/object/emboss/emboss_config.h"

#include <fmt/core.h>

#include "common/base/units.h"

namespace tacipc {
namespace {

constexpr int kMaxVertices = 20'000'000;

}  // namespace

double EmbossConfig::free_radius_m() const {
  return coin.face_radius_m() - margin_m - relief.wall_m / 2 - relief.rounding_m;
}

EmbossConfig EmbossConfig::read(ConfigReader& in) {
  EmbossConfig config;
  ConfigReader coin = in.section("coin");
  config.coin = {.radius_m = length(coin, "radius_mm", Range::positive()),
                 .thickness_m = length(coin, "thickness_mm", Range::positive()),
                 .fillet_m = length(coin, "fillet_mm", Range::non_negative())};
  config.margin_m = length(coin, "margin_mm", Range::non_negative());
  if (config.coin.fillet_m >= config.coin.thickness_m) {
    coin.fault("fillet_mm", fmt::format("must be below thickness_mm, {:.6g}", config.coin.thickness_m / kMillimetre));
    config.coin.fillet_m = 0.0;
  }
  ConfigReader relief = in.section("relief");
  config.relief = {.height_m = length(relief, "height_mm", Range::positive()),
                   .wall_m = length(relief, "wall_mm", Range::positive()),
                   .rounding_m = length(relief, "rounding_mm", Range::positive())};
  if (auto roughness = relief.optional_section("roughness")) {
    config.roughness = {.height_m = length(*roughness, "height_mm", Range::positive()),
                        .size_m = length(*roughness, "size_mm", Range::positive()),
                        .seed = static_cast<std::uint64_t>(roughness->integer("seed", 0))};
  }
  config.vertices = in.integer("vertices", 500, kMaxVertices);
  double free_radius = config.free_radius_m();
  if (free_radius <= 0.0) {
    coin.fault("radius_mm", "fillet, margin and the relief's wall leave no room on the face");
    free_radius = config.coin.radius_m;
  }
  ConfigReader pattern = in.section("pattern");
  config.pattern = read_pattern(pattern, free_radius);
  return config;
}

}  // namespace tacipc
