// Grasps that a small network tells apart in seconds, and shards of them.
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "common/base/rng.h"
#include "common/base/sha256.h"
#include "common/format/hdf5_writer.h"
#include "common/sample/motion.h"
#include "stages/image/depthnet/outcome_config.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {

inline constexpr int kGraspSize = 20;
/// Frames of each finger: one open, two while it closes, of which the second one is closed, then one of a hold and two
/// of a lift.
inline constexpr PhaseKind kGraspPhases[] = {PhaseKind::reference, PhaseKind::close, PhaseKind::close,
                                             PhaseKind::hold,      PhaseKind::lift,  PhaseKind::lift};
inline constexpr std::size_t kGraspFrames = 6, kClosed = 2, kHeldStill = 3;

struct MadeGrasp {
  std::string split, object, outcome;
  double grip_n = 0.0;
  bool moves = false;  // what the fingers see in the hold; while they lift they see the outcome in any case
};

/// A mark, as large and bright as it happens to be, that sinks by two pixels in the hold or not. The lift whitens the
/// image of a held object.
inline ByteImage made_image(const MadeGrasp& grasp, std::size_t index, std::size_t finger, std::size_t frame) {
  const auto draw = [&](std::uint64_t counter) { return random_uniform(9, 2 * index + finger, counter); };
  const double x0 = 7.0 + 6.0 * draw(0), y0 = 6.0 + 6.0 * draw(1) + (frame == kHeldStill && grasp.moves ? 2.0 : 0.0),
               radius = 2.5 + 1.5 * draw(2), bright = 40.0 + 40.0 * draw(3);
  ByteImage image(kGraspSize, kGraspSize, 3, 120);
  if (frame == 0) return image;
  for (int y = 0; y < kGraspSize; ++y)
    for (int x = 0; x < kGraspSize; ++x)
      for (int c = 0; c < 3; ++c) {
        const double r2 = ((x - x0) * (x - x0) + (y - y0) * (y - y0)) / (radius * radius);
        image.at(x, y, c) = static_cast<std::uint8_t>(120.5 + bright * std::exp(-r2));
        if (frame > kHeldStill && grasp.outcome == "lifted") image.at(x, y, c) = 250;
      }
  return image;
}

/// Half of each object's grasps are held. Fingers see that one is not where `visible`, else something that has nothing
/// to do with it; the grip says nothing in either case.
inline std::vector<MadeGrasp> made_grasps(std::size_t of_each_object, bool visible) {
  std::vector<MadeGrasp> grasps;
  const std::pair<const char*, const char*> objects[] = {{"ball", "train"}, {"box", "train"}, {"cone", "train"},
                                                         {"disc", "val"},   {"edge", "test"}, {"fork", "test"}};
  for (std::size_t o = 0; o < std::size(objects); ++o)
    for (std::size_t i = 0; i < of_each_object; ++i) {
      const std::size_t index = grasps.size();
      const bool held = i % 2 == 0;
      grasps.push_back({.split = objects[o].second,
                        .object = objects[o].first,
                        .outcome = held         ? "lifted"
                                   : i % 4 == 1 ? "dropped"
                                                : "slipped",
                        .grip_n = 1.0 + 4.0 * random_uniform(3, index, 0),
                        .moves = visible ? !held : random_uniform(3, index, 1) < 0.5});
    }
  return grasps;
}

/// As pack writes them; every grasp has its left finger in one shard, its right one in another. Returns the list.
inline std::filesystem::path write_grasps(const ScratchFolder& scratch, const std::vector<MadeGrasp>& grasps,
                                          double judged_frame = 5) {
  std::string list;
  for (std::size_t finger = 0; finger < 2; ++finger) {
    const std::string shard = finger == 0 ? "lefts" : "rights";
    const std::filesystem::path file = scratch / fmt::format("shards/{0}/{0}.h5", shard);
    std::filesystem::create_directories(file.parent_path());
    {
      Hdf5Writer writer(file);
      for (std::size_t i = 0; i < grasps.size(); ++i) {
        const MadeGrasp& grasp = grasps[i];
        const std::string sample = fmt::format("/data/s{:03}", 2 * i + finger);
        writer.group(sample + "/obs");
        writer.attribute(sample, "split", grasp.split);
        writer.attribute(sample, "object_id", grasp.object);
        writer.attribute(sample, "grasp", fmt::format("s{:03}", 2 * i));
        writer.attribute(sample, "finger", finger == 0 ? "left" : "right");
        writer.attribute(sample, "outcome", grasp.outcome);
        writer.attribute(sample, "judged_frame", judged_frame);
        writer.attribute(sample, "grip_N", grasp.grip_n + (finger == 0 ? 0.1 : -0.1));
        std::string rgb;
        std::vector<double> phase, number, time_s, slip_mm;
        for (std::size_t t = 0; t < kGraspFrames; ++t) {
          const ByteImage image = made_image(grasp, i, finger, t);
          rgb.append(image.pixels.begin(), image.pixels.end());
          phase.push_back(static_cast<double>(kGraspPhases[t]));
          number.push_back(static_cast<double>(t));
          time_s.push_back(0.01 * static_cast<double>(t));
          slip_mm.push_back(t > kClosed ? 0.25 * static_cast<double>(t) : 0.0);
        }
        const auto write = [&](const char* name, NumberType type, const std::vector<double>& values) {
          writer.write(sample + "/obs/" + name, type, {values.size()}, to_bytes(type, values));
        };
        writer.write(sample + "/obs/rgb", NumberType::u8, {kGraspFrames, kGraspSize, kGraspSize, 3}, rgb);
        write("phase", NumberType::u8, phase);
        write("frame", NumberType::i32, number);
        write("time_s", NumberType::f64, time_s);
        write("slip_mm", NumberType::f32, slip_mm);
      }
      writer.close();
    }
    write_file(scratch / fmt::format("shards/{0}/{0}.h5.sha256", shard),
               fmt::format("{}  {}.h5\n", sha256_of_file(file), shard));
    write_file(scratch / fmt::format("shards/{}/pack.yaml", shard), "stage: pack\n");
    list += shard + "/pack.yaml\n";
  }
  write_file(scratch / "shards/shards.txt", list);
  return scratch / "shards/shards.txt";
}

inline const char* const kSmallOutcome = R"(
task: outcome
network: {levels: 2, base_channels: 4, reduction: 1}
hidden: 8
schedule: {epochs: 8, batch: 4, learning_rate: 0.01, warmup_epochs: 1, weight_decay: 0.001, gradient_norm: 1}
augmentation: {gain: 0.05, drift_codes: 1, noise_codes: 0.5, shift_px: 1}
frames: 2
seeds: 2
seed: 4
)";

inline OutcomeConfig small_outcome() {
  return std::get<OutcomeConfig>(config_from_text<TaskConfig>(kSmallOutcome, "small.yaml").task);
}

}  // namespace tacipc
