// Samples of a dataset: names, seeds, splits, shards, and the numbers that each draws.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/rng.h"
#include "stages/dataset/plan/dataset_config.h"

namespace tacipc {

/// Seed for a name in a dataset of this global seed: 53 bits, which every JSON and YAML reader keeps exactly.
constexpr std::uint64_t seed_of(std::uint64_t global_seed, std::string_view name) {
  return random_bits(global_seed, hash_of(name), 0) >> 11;
}

enum class Split { train, val, test };
const char* name_of(Split split);

/// One sample of the plan.
struct PlannedSample {
  std::string id;  // <sensor>__<object>__<motion>__<index>
  int index = 0;
  std::optional<int> finger = std::nullopt;  // finger of a grasp, whose two fingers are adjacent: 0 left, 1 right
  std::string grasp = {};                    // name of the grasp: id of its left finger
  int sensor = 0, object = 0, motion = 0;    // indices of the configuration's lists
  int repetition = 0;                        // number of earlier samples of the same sensor, object and motion
  std::uint64_t seed = 0;                    // hash of the dataset's seed and the id
  Split split = Split::train;                // split by object: no object is in two splits
  Split split_pose =
      Split::train;        // split by pose: a motion's n-th sample has the same one for all objects and sensors
  std::string shard = {};  // <split>-00000-of-00001

  /// Folder in the dataset, with at most a thousand samples per parent folder. The fingers of a grasp lie in its
  /// folder.
  std::string folder() const;
  /// Folder of sample.yaml: the sample's, or that of the grasp of which it is a finger.
  std::string press_folder() const;
};

/// Number of samples per folder below samples/, and per block in which make reads the plan.
constexpr int kSamplesOfAFolder = 1000;

/// Packed bytes of one rendered frame per pixel: 2.2 MB for 640 × 480 with the profile `full` (docs/pack.md).
constexpr double kPackedBytesPerPixel = 7.2;

/// All samples, in the order of their indices. Repetitions are outermost: the first part of a dataset contains all
/// objects and motions, and additional repetitions come last. `packed_bytes[sensor][motion]` is the expected size of a
/// sample in a shard.
std::vector<PlannedSample> plan_samples(const DatasetConfig& config,
                                        const std::vector<std::vector<double>>& packed_bytes);

/// Number in [0, 1) that a sample draws along a dimension. Low discrepancy: point `repetition` of Sobol's sequence,
/// shifted modulo 1 by a number that depends only on object and motion. All sensors then get the same poses, and the
/// samples of an object fill the ranges evenly. Otherwise a random number of the sample. [Cranley and Patterson 1976]
double drawn_number(const DatasetConfig& config, const PlannedSample& sample, int dimension);

/// Seed of a drawn grasp. As for drawn_number, it is the same for all sensors, or the sample's own.
std::uint64_t draw_seed(const DatasetConfig& config, const PlannedSample& sample);

/// Sample in the format of press --sample.
std::string sample_yaml(const DatasetConfig& config, const PlannedSample& sample);

/// Name of the path file of a motion's phase, in the plan's folder.
std::string path_name(const DatasetConfig& config, int motion, int phase);

/// samples.csv: one row per sample.
std::string samples_csv(const DatasetConfig& config, const std::vector<PlannedSample>& samples);

}  // namespace tacipc
