#include "stages/dataset/plan/sample_plan.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

#include "common/base/error.h"
#include "stages/dataset/plan/plan_checks.h"
#include "stages/dataset/plan/plan_files.h"
#include "tests/config_text.h"

namespace tacipc {
namespace sample_plan_test {

/// Objects a, b, …, one sensor or two, a press with three ranges; no files.
DatasetConfig dataset(int objects, int samples, int sensors = 1) {
  DatasetConfig config;
  config.seed = 7;
  for (int s = 0; s < sensors; ++s)
    config.sensors.push_back({.name = "sensor" + std::to_string(s), .mesh = "tiny", .sensor = "", .mesh_config = ""});
  for (int o = 0; o < objects; ++o)
    config.objects.push_back({.name = "object" + std::to_string(o), .file = "", .embossed = true});
  config.motions.push_back({.name = "press",
                            .samples = samples,
                            .press = "",
                            .motion = config_from_text<MotionTemplate>(
                                "placement: {center_mm: {x: [-2, 2], y: [-1, 1]}, rotate_deg: [0, 360]}\n"
                                "motion: {kind: press, depth_mm: [0.2, 0.4], steps: 1}\n",
                                "m.yaml")});
  return config;
}

std::vector<PlannedSample> planned(const DatasetConfig& config, double bytes = 1.0) {
  return plan_samples(config, std::vector(config.sensors.size(), std::vector<double>(config.motions.size(), bytes)));
}

TEST(SamplePlan, NamesAndFolders) {
  const auto samples = planned(dataset(600, 2));
  ASSERT_EQ(samples.size(), 1200u);
  EXPECT_EQ(samples[0].id, "sensor0__object0__press__000000");
  EXPECT_EQ(samples[1100].folder(), "samples/001/sensor0__object500__press__001100");
  std::set<std::string> ids;
  for (const auto& sample : samples) ids.insert(sample.id);
  EXPECT_EQ(ids.size(), samples.size());
}

/// The same with a grasp of each object, too.
DatasetConfig dataset_of_grasps(int objects, int samples, int sensors = 1) {
  DatasetConfig config = dataset(objects, samples, sensors);
  config.motions.push_back(
      {.name = "grasp",
       .samples = samples,
       .press = "",
       .motion = config_from_text<MotionTemplate>("fingers: {draw: {}}\nobject: {friction_margin: [0.5, 4]}\n"
                                                  "motion: {kind: close, force_n: [1, 5], steps: 3}\n",
                                                  "m.yaml")});
  return config;
}

TEST(SamplePlan, FingersOfAGraspFollowEachOtherInItsFolder) {
  auto config = dataset_of_grasps(5, 4);
  config.splits = {.val = 0.2, .test = 0.2};
  const auto samples = planned(config);
  ASSERT_EQ(samples.size(), 60u);
  EXPECT_FALSE(samples[0].finger);
  EXPECT_EQ(samples[1].id, "sensor0__object0__grasp__000001");
  EXPECT_EQ(samples[1].folder(), "samples/000/sensor0__object0__grasp__000001/left");
  EXPECT_EQ(samples[2].id, "sensor0__object0__grasp__000002");
  EXPECT_EQ(samples[2].folder(), "samples/000/sensor0__object0__grasp__000001/right");
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    EXPECT_EQ(samples[i].index, static_cast<int>(i));
    if (samples[i].finger != 0) continue;
    EXPECT_EQ(samples[i + 1].finger, 1);
    EXPECT_EQ(samples[i].press_folder(), samples[i + 1].press_folder());
    EXPECT_EQ(samples[i].split, samples[i + 1].split);
    EXPECT_EQ(samples[i].split_pose, samples[i + 1].split_pose);
    EXPECT_NE(samples[i].seed, samples[i + 1].seed);
  }
}

TEST(SamplePlan, SensorsDrawTheSameGraspAndSamplesOthers) {
  auto config = dataset_of_grasps(2, 2, 2);
  std::map<std::string, std::set<std::uint64_t>> seeds;
  for (const auto& sample : planned(config))
    if (sample.finger == 0)
      seeds[std::to_string(sample.object) + "-" + std::to_string(sample.repetition)].insert(draw_seed(config, sample));
  ASSERT_EQ(seeds.size(), 4u);
  std::set<std::uint64_t> all;
  for (const auto& [name, of_sensors] : seeds) {
    EXPECT_EQ(of_sensors.size(), 1u) << name;
    all.insert(of_sensors.begin(), of_sensors.end());
  }
  EXPECT_EQ(all.size(), 4u);
  config.low_discrepancy = false;
  for (const auto& sample : planned(config)) EXPECT_EQ(draw_seed(config, sample), sample.seed);
}

TEST(SamplePlan, AGraspInTwoBlocksHasItsRuleInBoth) {
  DatasetConfig config = dataset_of_grasps(500, 1);
  std::swap(config.motions[0], config.motions[1]);  // the fingers of object 333 are 999 and 1000
  const auto samples = planned(config);
  ASSERT_EQ(samples[999].finger, 0);
  EXPECT_EQ(samples[1000].folder().substr(0, 12), "samples/000/");
  const auto files = plan_files(config, {}, samples);
  const auto content = [&](const std::string& name) {
    for (const auto& [file, text] : files)
      if (file == name) return text;
    return std::string();
  };
  const std::string call = "dataset_grasp,000/" + samples[999].id + ",";
  EXPECT_THAT(content("blocks/000.mk"), testing::HasSubstr(call));
  EXPECT_THAT(content("blocks/001.mk"), testing::HasSubstr(call));
  EXPECT_THAT(content("blocks/001.mk"), testing::HasSubstr("DATASET_BLOCK_001 := 000/" + samples[999].id + "/right "));
}

TEST(SamplePlan, MoreRepetitionsLeaveTheFirstAsTheyWere) {
  const auto few = planned(dataset(5, 4)), many = planned(dataset(5, 9));
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].id, many[i].id);
    EXPECT_EQ(few[i].seed, many[i].seed);
    EXPECT_EQ(few[i].split_pose, many[i].split_pose);
    EXPECT_EQ(sample_yaml(dataset(5, 4), few[i]), sample_yaml(dataset(5, 9), many[i]));
  }
}

TEST(SamplePlan, SeedsAreOfSeedAndName) {
  auto config = dataset(2, 2);
  const auto samples = planned(config);
  EXPECT_EQ(samples[1].seed, seed_of(7, samples[1].id));
  EXPECT_NE(samples[0].seed, samples[1].seed);
  EXPECT_LT(samples[0].seed, 1ull << 53);
  config.seed = 8;
  EXPECT_NE(planned(config)[1].seed, samples[1].seed);
}

TEST(SamplePlan, NoObjectIsInTwoSplits) {
  auto config = dataset(20, 5, 2);
  config.splits = {.val = 0.1, .test = 0.2};
  std::map<int, std::set<Split>> of;
  std::map<Split, int> count;
  for (const auto& sample : planned(config)) {
    of[sample.object].insert(sample.split);
    ++count[sample.split];
  }
  for (const auto& [object, splits] : of) EXPECT_EQ(splits.size(), 1u) << "object " << object;
  EXPECT_EQ(count[Split::val], 20);   // two of twenty objects, five samples in two sensors each
  EXPECT_EQ(count[Split::test], 40);  // four
}

TEST(SamplePlan, NamedObjectsAreWhereTheyWereNamed) {
  auto config = dataset(10, 1);
  config.splits = {
      .val = 0.1, .test = 0.2, .val_objects = {"object3"}, .test_objects = {"object0", "object9", "object4"}};
  for (const auto& sample : planned(config)) {
    const bool test = sample.object == 0 || sample.object == 9 || sample.object == 4;
    EXPECT_EQ(sample.split, test ? Split::test : sample.object == 3 ? Split::val : Split::train) << sample.id;
  }
}

TEST(SamplePlan, PosesAreSplitAlikeForAllObjectsAndInTheSharesAskedFor) {
  auto config = dataset(4, 50, 2);
  config.splits = {.val = 0.1, .test = 0.2};
  std::map<int, Split> of;
  for (const auto& sample : planned(config)) {
    const auto [at, added] = of.emplace(sample.repetition, sample.split_pose);
    EXPECT_EQ(at->second, sample.split_pose) << sample.id;
  }
  std::map<Split, int> count;
  for (const auto& [repetition, split] : of) ++count[split];
  EXPECT_NEAR(count[Split::val], 5, 1);
  EXPECT_NEAR(count[Split::test], 10, 1);
}

TEST(SamplePlan, ShardsHoldOneSplitEachAndAboutAsMuchAsAskedFor) {
  auto config = dataset(10, 10);
  config.splits = {.val = 0.1, .test = 0.2};
  config.shard_bytes = 250.0;
  std::map<std::string, int> count;
  for (const auto& sample : planned(config, 10.0)) {
    EXPECT_TRUE(sample.shard.starts_with(name_of(sample.split))) << sample.shard;
    ++count[sample.shard];
  }
  EXPECT_THAT(count,
              testing::ElementsAre(testing::Pair("test-00000-of-00001", 20), testing::Pair("train-00000-of-00003", 24),
                                   testing::Pair("train-00001-of-00003", 23), testing::Pair("train-00002-of-00003", 23),
                                   testing::Pair("val-00000-of-00001", 10)));
}

TEST(Drawn, LowDiscrepancyFillsEachRangeEvenlyForEachObject) {
  const auto config = dataset(3, 16);
  std::map<std::pair<int, int>, std::set<int>> sixteenths;
  for (const auto& sample : planned(config))
    for (int d = 0; d < 4; ++d) {
      const double u = drawn_number(config, sample, d);
      EXPECT_TRUE(u >= 0.0 && u < 1.0);
      // A shift moves all points of a range alike, so they stay one sixteenth apart.
      sixteenths[{sample.object, d}].insert(
          static_cast<int>(std::floor(16 * (u - drawn_number(config, planned(config)[0], d)) + 1e-6)) & 15);
    }
  ASSERT_EQ(sixteenths.size(), 12u);
  for (const auto& [key, hit] : sixteenths)
    EXPECT_EQ(hit.size(), 16u) << "object " << key.first << ", dimension " << key.second;
}

TEST(Drawn, SensorsSeeTheSamePosesAndObjectsOthers) {
  const auto config = dataset(2, 3, 2);
  std::map<std::pair<int, int>, std::set<double>> x;
  std::set<double> all;
  for (const auto& sample : planned(config)) {
    x[{sample.object, sample.repetition}].insert(drawn_number(config, sample, 0));
    all.insert(drawn_number(config, sample, 0));
  }
  for (const auto& [key, values] : x) EXPECT_EQ(values.size(), 1u);
  EXPECT_EQ(all.size(), 6u);
}

TEST(Drawn, RandomNumbersAreOfTheSampleAlone) {
  auto config = dataset(10, 100);
  config.low_discrepancy = false;
  double mean = 0.0;
  std::set<double> all;
  const auto samples = planned(config);
  for (const auto& sample : samples) {
    const double u = drawn_number(config, sample, 1);
    mean += u / static_cast<double>(samples.size());
    all.insert(u);
  }
  EXPECT_EQ(all.size(), samples.size());
  EXPECT_NEAR(mean, 0.5, 0.03);  // three standard deviations of the mean of a thousand
}

TEST(PlanChecks, WhatNoSampleCouldDoIsSaid) {
  auto config = dataset(2, 1);
  Sensor sensor;
  sensor.gel = {.radius_m = 15e-3, .thickness_m = 2e-3};
  EXPECT_TRUE(faults_of_plan(config, {sensor}, "d.yaml").empty());
  config.motions[0].motion.phases[0].numbers[0].draw = {0.5, 2.0};
  config.motions[0].motion.center_x_mm = {-2.0, 16.0};
  config.motions[0].samples = 500001;
  EXPECT_THAT(
      faults_of_plan(config, {sensor}, "d.yaml"),
      testing::ElementsAre("d.yaml: motion press: a press to 2 mm is not possible in the gel of sensor0, 2 mm thick",
                           "d.yaml: motion press: some places of center_mm lie beside the gel of sensor0",
                           "d.yaml: 1000002 samples; a dataset has at most 999999"));
}

}  // namespace sample_plan_test
}  // namespace tacipc
