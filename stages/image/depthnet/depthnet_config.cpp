#include "stages/image/depthnet/depthnet_config.h"

namespace tacipc {
namespace {

LossConfig read_loss(ConfigReader in) {
  return {.squared = in.choice("kind", {"mae", "mse"}) == "mse",
          .contact_weight = in.number("contact_weight", Range::between(0.0, 1000.0)),
          .slope_weight = in.number("slope_weight", Range::between(0.0, 1000.0))};
}

}  // namespace

NetworkConfig read_network(ConfigReader in) {
  return {.levels = in.integer("levels", 1, NetworkConfig::kMostLevels),
          .base_channels = in.integer("base_channels", 1, NetworkConfig::kMostChannels),
          .reduction = in.integer("reduction", 1, NetworkConfig::kMostReduction)};
}

ScheduleConfig read_schedule(ConfigReader in) {
  const ScheduleConfig schedule{
      .epochs = in.integer("epochs", 1, 100000),
      .batch = in.integer("batch", 1, 4096),
      .learning_rate = in.number("learning_rate", {.low = 0.0, .high = 1.0, .open_low = true}),
      .warmup_epochs = in.number("warmup_epochs", Range::non_negative()),
      .weight_decay = in.number("weight_decay", Range::between(0.0, 1.0)),
      .gradient_norm = in.number("gradient_norm", Range::positive())};
  if (schedule.warmup_epochs > schedule.epochs) in.fault("warmup_epochs", "is longer than the training");
  return schedule;
}

AugmentationConfig read_augmentation(ConfigReader in, bool reference) {
  const Range codes = Range::between(0.0, 128.0);
  return {.gain = in.number("gain", Range::between(0.0, 1.0)),
          .drift_codes = in.number("drift_codes", codes),
          .noise_codes = in.number("noise_codes", codes),
          .reference_codes = reference ? in.number("reference_codes", codes) : 0.0,
          .shift_px = in.integer("shift_px", 0, 64)};
}

DepthnetConfig DepthnetConfig::read(ConfigReader& in) {
  return {.network = read_network(in.section("network")),
          .loss = read_loss(in.section("loss")),
          .schedule = read_schedule(in.section("schedule")),
          .augmentation = read_augmentation(in.section("augmentation")),
          .last_frame = in.choice("frames", {"all", "last"}) == "last",
          .shuffle_pairs = in.flag_or("shuffle_pairs", false),
          .seed = static_cast<std::uint64_t>(in.integer("seed", 0))};
}

}  // namespace tacipc
