#include "common/benchmark/unet.h"

namespace tacipc {
namespace {

/// Divisors of 8-bit values, which bring the network's input to the order of one.
constexpr double kChangeCodes = 32.0, kReferenceCodes = 128.0;

}  // namespace

int channels_of(const NetworkConfig& config, int level) { return config.base_channels << level; }

void write_contracting_path(const NetworkConfig& config, NetworkWriter& writer) {
  const auto channels = [&](int level) { return channels_of(config, level); };
  for (int level = 0; level <= config.levels; ++level) {
    if (level > 0) writer.halve();
    writer.convolution(level > 0 ? channels(level - 1) : kSeenChannels, channels(level), 3, true);
    writer.convolution(channels(level), channels(level), 3, true);
    if (level < config.levels) writer.keep(level);
  }
}

void write_unet(const NetworkConfig& config, NetworkWriter& writer) {
  const auto channels = [&](int level) { return channels_of(config, level); };
  writer.begin(kChangeCodes, kReferenceCodes, 1 << config.levels);
  write_contracting_path(config, writer);
  for (int level = config.levels - 1; level >= 0; --level) {
    writer.enlarge_and_join(level);
    writer.convolution(channels(level) + channels(level + 1), channels(level), 3, true);
    writer.convolution(channels(level), channels(level), 3, true);
  }
  writer.convolution(channels(0), 1, 1, false);
  writer.end();
}

std::string weight_name(int convolution) { return "w" + std::to_string(convolution); }
std::string bias_name(int convolution) { return weight_name(convolution) + "b"; }

}  // namespace tacipc
