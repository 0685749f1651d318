// Images that a small network learns from in seconds, and files of them.
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/base/rng.h"
#include "common/base/sha256.h"
#include "common/format/hdf5_writer.h"
#include "stages/image/depthnet/depthnet_config.h"
#include "stages/image/depthnet/training_set.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {

inline constexpr int kSize = 36;

/// Smooth dents, one an image, lit from three sides: codes change with the slope, as a gel's do.
inline DepthImage dent(std::size_t index) {
  const auto draw = [&](std::uint64_t counter) { return random_uniform(5, index, counter); };
  const double x0 = 10.0 + 16.0 * draw(0), y0 = 10.0 + 16.0 * draw(1), radius = 5.0 + 4.0 * draw(2),
               deep = 0.3 + 0.6 * draw(3);
  DepthImage out{.name = fmt::format("dent_{}", index),
                 .split = "train",
                 .image = ByteImage(kSize, kSize, 3),
                 .reference = ByteImage(kSize, kSize, 3, 120),
                 .depth_mm = FloatImage(kSize, kSize, 1)};
  const auto depth = [&](double x, double y) {
    const double r2 = ((x - x0) * (x - x0) + (y - y0) * (y - y0)) / (radius * radius);
    return r2 < 1.0 ? deep * (1.0 - r2) * (1.0 - r2) : 0.0;
  };
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      out.depth_mm.at(x, y, 0) = static_cast<float>(depth(x, y));
      const double sx = 0.5 * (depth(x + 1, y) - depth(x - 1, y)), sy = 0.5 * (depth(x, y + 1) - depth(x, y - 1));
      for (int c = 0; c < 3; ++c) {
        const double angle = 2.0 * std::numbers::pi * c / 3.0;
        out.image.at(x, y, c) =
            static_cast<std::uint8_t>(120.5 + 350.0 * (std::cos(angle) * sx + std::sin(angle) * sy));
      }
    }
  return out;
}

inline const char* const kSmall = R"(
network: {levels: 2, base_channels: 6, reduction: 1}
loss: {kind: mae, contact_weight: 2, slope_weight: 0.5}
schedule: {epochs: 25, batch: 4, learning_rate: 0.005, warmup_epochs: 1, weight_decay: 0.0001, gradient_norm: 1}
augmentation: {gain: 0.05, drift_codes: 2, noise_codes: 1, reference_codes: 4, shift_px: 2}
frames: all
seed: 3
)";

inline DepthnetConfig small_config(int epochs = 25) {
  auto config = config_from_text<DepthnetConfig>(kSmall, "small.yaml");
  config.schedule.epochs = epochs;
  return config;
}

inline std::vector<DepthItem> dents(const torch::jit::Module& network, std::size_t begin, std::size_t count) {
  std::vector<DepthItem> items;
  for (std::size_t i = begin; i < begin + count; ++i) items.push_back(item_of(dent(i), network, 1));
  return items;
}

/// A shard as pack writes it: samples 0 … of three frames, the first without contact.
inline std::filesystem::path write_shard(const ScratchFolder& scratch, const std::vector<std::string>& splits,
                                         NumberType depth_type = NumberType::f32) {
  std::filesystem::path file = scratch / "shards/one/one.h5";
  std::filesystem::create_directories(file.parent_path());
  {
    Hdf5Writer writer(file);
    for (std::size_t i = 0; i < splits.size(); ++i) {
      const std::string sample = fmt::format("/data/s{}", i);
      writer.group(sample + "/obs");
      writer.attribute(sample, "split", splits[i]);
      const std::vector<DepthImage> touched{dent(2 * i), dent(2 * i + 1)};
      std::string rgb(touched[0].reference.pixels.begin(), touched[0].reference.pixels.end());
      std::vector<double> depth(kSize * kSize, 0.0);
      for (const DepthImage& image : touched) {
        rgb.append(image.image.pixels.begin(), image.image.pixels.end());
        depth.insert(depth.end(), image.depth_mm.pixels.begin(), image.depth_mm.pixels.end());
      }
      writer.write(sample + "/obs/rgb", NumberType::u8, {3, kSize, kSize, 3}, rgb);
      writer.write(sample + "/obs/indentation_mm", depth_type, {3, kSize, kSize}, to_bytes(depth_type, depth));
    }
    writer.close();
  }
  write_file(scratch / "shards/one/one.h5.sha256", sha256_of_file(file) + "  one.h5\n");
  write_file(scratch / "shards/one/pack.yaml", "stage: pack\n");
  write_file(scratch / "shards/shards.txt", "one/pack.yaml\n");
  return file;
}

}  // namespace tacipc
