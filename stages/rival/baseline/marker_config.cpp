#include "stages/rival/baseline/marker_config.h"

namespace tacipc {

MarkerMotionConfig MarkerMotionConfig::read(ConfigReader& file) {
  ConfigReader in = file.section("markers");
  MarkerMotionConfig config;
  if (in.choice("model", {"fots", "superposition"}) == "superposition") {
    config.model = Model::superposition;
    return config;
  }
  constexpr double kPerMm2 = 1e6;
  config.fots.press_per_m2 = kPerMm2 * in.number("press_per_mm2", Range::positive());
  config.fots.shear_per_m2 = kPerMm2 * in.number("shear_per_mm2", Range::positive());
  config.fots.twist_per_m2 = kPerMm2 * in.number("twist_per_mm2", Range::positive());
  const auto first = in.numbers("first_px", 2), pitch = in.numbers("pitch_px", 2, Range::positive());
  config.fots.first_px = {first[0], first[1]};
  config.fots.pitch_px = {pitch[0], pitch[1]};
  config.fots.columns = in.integer("columns", 1, 1000);
  config.fots.rows = in.integer("rows", 1, 1000);
  return config;
}

}  // namespace tacipc
