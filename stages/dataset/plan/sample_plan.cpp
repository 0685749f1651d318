#include "stages/dataset/plan/sample_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/base/sobol.h"
#include "common/sample/dataset_plan.h"

namespace tacipc {
namespace {

constexpr double kGoldenRatio = 0.6180339887498949;

double fraction(double x) { return x - std::floor(x); }

/// Split of each object: first the named objects, then by hash as many as the fraction requires (at least one if three
/// or more objects are left).
std::vector<Split> object_splits(const DatasetConfig& config) {
  const Splits& splits = config.splits;
  std::vector<Split> of(config.objects.size(), Split::train);
  std::vector<std::size_t> open;
  int named[] = {0, 0, 0};
  for (std::size_t o = 0; o < of.size(); ++o) {
    const auto is_in = [&](const std::vector<std::string>& list) {
      return std::find(list.begin(), list.end(), config.objects[o].name) != list.end();
    };
    of[o] = is_in(splits.val_objects) ? Split::val : is_in(splits.test_objects) ? Split::test : Split::train;
    ++named[static_cast<int>(of[o])];
    if (of[o] == Split::train) open.push_back(o);
  }
  const auto seed = static_cast<std::uint64_t>(config.seed);
  std::sort(open.begin(), open.end(), [&](std::size_t a, std::size_t b) {
    return seed_of(seed, "split " + config.objects[a].name) < seed_of(seed, "split " + config.objects[b].name);
  });
  const bool enough = open.size() >= 3;
  std::size_t next = 0;
  for (const auto& [split, share] : {std::pair{Split::val, splits.val}, {Split::test, splits.test}}) {
    int wanted = static_cast<int>(std::lround(share * static_cast<double>(of.size())));
    if (share > 0.0 && enough) wanted = std::max(wanted, 1);
    for (wanted -= named[static_cast<int>(split)]; wanted > 0 && next + 1 < open.size(); --wanted)
      of[open[next++]] = split;
  }
  return of;
}

/// Split of a pose. Repetition r of a motion lies at fraction(u + r / golden ratio) of [0, 1); test has the lowest part
/// and val the next. The distribution is as even as possible for every number of repetitions. [Weyl 1916]
Split pose_split(const DatasetConfig& config, int motion, int repetition) {
  const double start = random_uniform(seed_of(static_cast<std::uint64_t>(config.seed), "pose split"),
                                      hash_of(config.motions[static_cast<std::size_t>(motion)].name), 0);
  const double at = fraction(start + repetition * kGoldenRatio);
  if (at < config.splits.test) return Split::test;
  return at < config.splits.test + config.splits.val ? Split::val : Split::train;
}

void assign_shards(std::vector<PlannedSample>& samples, double shard_bytes,
                   const std::vector<std::vector<double>>& packed_bytes) {
  for (const Split split : {Split::train, Split::val, Split::test}) {
    std::vector<PlannedSample*> members;
    double bytes = 0.0;
    for (PlannedSample& sample : samples) {
      if (sample.split != split) continue;
      members.push_back(&sample);
      bytes += packed_bytes[static_cast<std::size_t>(sample.sensor)][static_cast<std::size_t>(sample.motion)];
    }
    const auto shards = std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(bytes / shard_bytes)), 1,
                                                std::max<std::size_t>(members.size(), 1));
    for (std::size_t k = 0; k < members.size(); ++k)
      members[k]->shard = fmt::format("{}-{:05}-of-{:05}", name_of(split), k * shards / members.size(), shards);
  }
}

}  // namespace

const char* name_of(Split split) { return split == Split::train ? "train" : split == Split::val ? "val" : "test"; }

std::string PlannedSample::press_folder() const {
  return fmt::format("samples/{:03}/{}", (index - finger.value_or(0)) / kSamplesOfAFolder, finger ? grasp : id);
}

std::string PlannedSample::folder() const {
  return press_folder() + (!finger ? "" : *finger == 0 ? "/left" : "/right");
}

std::vector<PlannedSample> plan_samples(const DatasetConfig& config,
                                        const std::vector<std::vector<double>>& packed_bytes) {
  const std::vector<Split> splits = object_splits(config);
  int repetitions = 0;
  for (const MotionChoice& motion : config.motions) repetitions = std::max(repetitions, motion.samples);
  std::vector<PlannedSample> samples;
  for (int r = 0; r < repetitions; ++r)
    for (std::size_t s = 0; s < config.sensors.size(); ++s)
      for (std::size_t o = 0; o < config.objects.size(); ++o)
        for (std::size_t m = 0; m < config.motions.size(); ++m) {
          if (config.motions[m].samples <= r) continue;
          const bool grasp = config.motions[m].motion.fingers.has_value();
          for (int side = 0; side < (grasp ? 2 : 1); ++side) {
            PlannedSample sample{.id = "",
                                 .index = static_cast<int>(samples.size()),
                                 .sensor = static_cast<int>(s),
                                 .object = static_cast<int>(o),
                                 .motion = static_cast<int>(m),
                                 .repetition = r};
            sample.id = fmt::format("{}__{}__{}__{:06}", config.sensors[s].name, config.objects[o].name,
                                    config.motions[m].name, sample.index);
            if (grasp) {
              sample.finger = side;
              sample.grasp = side == 0 ? sample.id : samples.back().id;
            }
            sample.seed = seed_of(static_cast<std::uint64_t>(config.seed), sample.id);
            sample.split = splits[o];
            sample.split_pose = pose_split(config, sample.motion, r);
            samples.push_back(std::move(sample));
          }
        }
  assign_shards(samples, config.shard_bytes, packed_bytes);
  return samples;
}

double drawn_number(const DatasetConfig& config, const PlannedSample& sample, int dimension) {
  const auto d = static_cast<std::uint64_t>(dimension);
  if (!config.low_discrepancy) return random_uniform(sample.seed, hash_of("plan"), d);
  const std::string& object = config.objects[static_cast<std::size_t>(sample.object)].name;
  const std::string& motion = config.motions[static_cast<std::size_t>(sample.motion)].name;
  const std::uint64_t seed = seed_of(static_cast<std::uint64_t>(config.seed), object + "__" + motion);
  return fraction(sobol(static_cast<std::uint32_t>(sample.repetition), dimension) +
                  random_uniform(seed, hash_of("plan"), d));
}

std::uint64_t draw_seed(const DatasetConfig& config, const PlannedSample& sample) {
  if (!config.low_discrepancy) return sample.seed;
  return seed_of(static_cast<std::uint64_t>(config.seed),
                 fmt::format("grasp {}__{}__{}", config.objects[static_cast<std::size_t>(sample.object)].name,
                             config.motions[static_cast<std::size_t>(sample.motion)].name, sample.repetition));
}

std::string path_name(const DatasetConfig& config, int motion, int phase) {
  return fmt::format("paths/{}_{}.csv", config.motions[static_cast<std::size_t>(motion)].name, phase);
}

std::string sample_yaml(const DatasetConfig& config, const PlannedSample& sample) {
  const MotionTemplate& motion = config.motions[static_cast<std::size_t>(sample.motion)].motion;
  // The gel is not part of the name, but decides which press belongs to the sample.
  return fmt::format("# {} in gel {}, seed {}\n", sample.id,
                     config.sensors[static_cast<std::size_t>(sample.sensor)].gel(), sample.seed) +
         motion.sample_yaml([&](int d) { return drawn_number(config, sample, d); },
                            [&](int phase) { return "../../../plan/" + path_name(config, sample.motion, phase); },
                            draw_seed(config, sample));
}

std::string samples_csv(const DatasetConfig& config, const std::vector<PlannedSample>& samples) {
  std::string text = plan_header();
  for (const PlannedSample& sample : samples) {
    const SensorChoice& sensor = config.sensors[static_cast<std::size_t>(sample.sensor)];
    text += plan_line({.id = sample.id,
                       .index = std::to_string(sample.index),
                       .split = name_of(sample.split),
                       .split_pose = name_of(sample.split_pose),
                       .seed = std::to_string(sample.seed),
                       .sensor = sensor.name,
                       .mesh = sensor.mesh,
                       .object = config.objects[static_cast<std::size_t>(sample.object)].name,
                       .motion = config.motions[static_cast<std::size_t>(sample.motion)].name,
                       .shard = sample.shard,
                       .folder = sample.folder()});
  }
  return text;
}

}  // namespace tacipc
