#include "stages/image/depthnet/outcome_config.h"

namespace tacipc {

OutcomeConfig OutcomeConfig::read(ConfigReader& in) {
  return {.network = read_network(in.section("network")),
          .hidden = in.integer("hidden", 1, 1024),
          .schedule = read_schedule(in.section("schedule")),
          .augmentation = read_augmentation(in.section("augmentation"), false),
          .frames = in.integer("frames", 1, 64),
          .seeds = in.integer("seeds", 1, 100),
          .seed = static_cast<std::uint64_t>(in.integer("seed", 0))};
}

TaskConfig TaskConfig::read(ConfigReader& in) {
  if (in.choice_or("task", "depth", {"depth", "outcome"}) == "outcome") return {OutcomeConfig::read(in)};
  return {DepthnetConfig::read(in)};
}

}  // namespace tacipc
