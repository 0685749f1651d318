// The samples of a dataset: names, seeds, splits, shards, and the numbers that each draws.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/rng.h"
#include "stages/dataset/plan/dataset_config.h"

namespace tacipc {

/// Seed of what has this name in a dataset of this global seed; 53 bits, which every reader of numbers keeps.
constexpr std::uint64_t seed_of(std::uint64_t global_seed, std::string_view name) {
  return random_bits(global_seed, hash_of(name), 0) >> 11;
}

enum class Split { train, val, test };
const char* name_of(Split split);

struct PlannedSample {
  std::string id;  // <sensor>__<object>__<motion>__<index>
  int index = 0;
  std::optional<int> finger = std::nullopt;  // of a grasp, whose two follow each other: 0 left, 1 right
  std::string grasp = {};                    // its name, the id of its left finger
  int sensor = 0, object = 0, motion = 0;    // of the configuration's lists
  int repetition = 0;                        // how many of the same sensor, object and motion there are before it
  std::uint64_t seed = 0;                    // hash of the dataset's seed and the id
  Split split = Split::train;                // by object: none of a split's objects is in another
  Split split_pose = Split::train;           // by pose: a motion's n-th sample has the same for all objects and sensors
  std::string shard = {};                    // <split>-00000-of-00001

  /// Where it lies in the dataset: at most a thousand beside each other. The fingers of a grasp lie in its folder.
  std::string folder() const;
  /// Folder of sample.yaml: that of the sample, or of the grasp that it is a finger of.
  std::string press_folder() const;
};

/// Of the folders below samples/, and of the blocks in which make reads the plan.
constexpr int kSamplesOfAFolder = 1000;

/// Packed bytes of one rendered frame per pixel: 2.2 MB for 640 × 480 with the profile `full` (docs/pack.md).
constexpr double kPackedBytesPerPixel = 7.2;

/// Every sample, in the order of their indices: repetitions outermost, so that the first part of a dataset has all
/// objects and motions in it, and more repetitions come last. `packed_bytes[sensor][motion]` is what a sample is
/// expected to take in a shard.
std::vector<PlannedSample> plan_samples(const DatasetConfig& config,
                                        const std::vector<std::vector<double>>& packed_bytes);

/// The number in [0, 1) that a sample draws along dimension d. Low discrepancy: point `repetition` of Sobol's sequence,
/// shifted by a number of object and motion alone (modulo 1), so that all sensors see the same poses and the samples of
/// an object fill the ranges evenly. Else a random number of the sample's own. [Cranley and Patterson 1976]
double drawn_number(const DatasetConfig& config, const PlannedSample& sample, int dimension);

/// Seed of a drawn grasp: like drawn_number(), the same for all sensors, or the sample's own.
std::uint64_t draw_seed(const DatasetConfig& config, const PlannedSample& sample);

/// What press reads as --sample. `plan_folder` is the plan's as seen from the sample's.
std::string sample_yaml(const DatasetConfig& config, const PlannedSample& sample);

/// Name in the plan's folder of the path file of a motion's phase.
std::string path_name(const DatasetConfig& config, int motion, int phase);

/// samples.csv: one row per sample.
std::string samples_csv(const DatasetConfig& config, const std::vector<PlannedSample>& samples);

}  // namespace tacipc
