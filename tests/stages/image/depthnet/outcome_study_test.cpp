#include "stages/image/depthnet/outcome_study.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "common/base/error.h"
#include "common/base/statistics.h"
#include "common/sample/shard_list.h"
#include "stages/image/depthnet/scores.h"
#include "tests/stages/image/depthnet/grasps.h"

namespace tacipc {
namespace outcome_study_test {

Checkpoints no_checkpoints(const std::string&) {
  return {.load = [] { return std::optional<std::string>(); }, .save = [](const std::string&) {}};
}

std::vector<GraspItem> items_of(const std::vector<MadeGrasp>& made, const OutcomeConfig& config) {
  const ScratchFolder scratch;
  return read_grasps(listed_shards(write_grasps(scratch, made)), config.frames,
                     make_outcome_network(config, config.seed));
}

/// Accuracies of the networks or of their controls.
std::vector<double> accuracies(const OutcomeStudy& study, bool shuffled) {
  std::vector<double> all;
  for (const OutcomeTraining& training : study.trainings)
    if (training.shuffled == shuffled) all.push_back(scores_of(training.probabilities, held_of(study.test)).accuracy);
  return all;
}

TEST(OutcomeStudy, ForetellsOutcomesThatFingersSeeAndTheGripDoesNotSay) {
  stay_in_this_thread();
  const OutcomeConfig config = small_outcome();
  const OutcomeStudy study = study_outcomes(items_of(made_grasps(20, true), config), config, no_checkpoints);
  ASSERT_EQ(study.test.size(), 40U);
  const auto [network, spread] = mean_and_deviation(accuracies(study, false));
  const auto [shuffled, shuffled_spread] = mean_and_deviation(accuracies(study, true));
  const double grip = scores_of(study.grip_only, held_of(study.test)).accuracy;
  EXPECT_GT(network, 0.9);
  EXPECT_GT(network - spread, shuffled + shuffled_spread);
  EXPECT_GT(network - spread, grip + 0.15);
}

TEST(OutcomeStudy, DoesNotForetellWhatIsNotInItsFrames) {
  stay_in_this_thread();
  const OutcomeConfig config = small_outcome();
  const OutcomeStudy study = study_outcomes(items_of(made_grasps(20, false), config), config, no_checkpoints);
  const auto [network, spread] = mean_and_deviation(accuracies(study, false));
  const auto [shuffled, shuffled_spread] = mean_and_deviation(accuracies(study, true));
  // Two accuracies of guesses differ by chance, too, of seeds and of 40 grasps.
  const double chance = std::sqrt(2.0 * 0.25 / static_cast<double>(study.test.size()));
  EXPECT_LT(network - shuffled, spread + shuffled_spread + 2.0 * chance);
  EXPECT_LT(network, 0.75);
}

TEST(OutcomeStudy, GoesOnAfterAnInterruptionToTheSameProbabilities) {
  stay_in_this_thread();
  OutcomeConfig config = small_outcome();
  config.schedule.epochs = 3;
  const std::vector<GraspItem> items = items_of(made_grasps(4, true), config);
  const OutcomeStudy whole = study_outcomes(items, config, no_checkpoints);
  std::map<std::string, std::string> kept;
  int saved = 0;
  const auto keeping = [&](const std::string& name) {
    return Checkpoints{.load = [&kept, name] { return kept.contains(name) ? std::optional(kept[name]) : std::nullopt; },
                       .save =
                           [&kept, &saved, name](const std::string& bytes) {
                             kept[name] = bytes;
                             if (++saved == 5) throw DataError("interrupted");
                           },
                       .between = std::chrono::seconds(0),
                       .at_end = true};
  };
  EXPECT_THROW(study_outcomes(items, config, keeping), DataError);
  EXPECT_EQ(kept.size(), 2U);
  const OutcomeStudy resumed = study_outcomes(items, config, keeping);
  EXPECT_EQ(saved, 5 + 1 + 2 * 3);  // one epoch of the second training, and two trainings
  ASSERT_EQ(resumed.trainings.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(resumed.trainings[k].name(), whole.trainings[k].name());
    EXPECT_EQ(resumed.trainings[k].probabilities, whole.trainings[k].probabilities);
    EXPECT_EQ(resumed.trainings[k].history.size(), 3U);
  }
}

TEST(OutcomeStudy, RefusesSplitsThatSayNothing) {
  stay_in_this_thread();
  const OutcomeConfig config = small_outcome();
  const std::vector<GraspItem> items = items_of(made_grasps(2, true), config);
  const auto refusal = [&](const auto& change) {
    std::vector<GraspItem> changed = items;
    change(changed);
    try {
      study_outcomes(changed, config, no_checkpoints);
    } catch (const DataError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refusal([](auto& all) { all.resize(8); }), testing::HasSubstr("the split test has no grasps"));
  EXPECT_THAT(refusal([](auto& all) {
                for (GraspItem& item : all) item.held = item.held && item.split != "test";
              }),
              testing::HasSubstr("the split test has 4 grasps of 2 objects, none held"));
  EXPECT_THAT(refusal([](auto& all) { all.back().object = "ball"; }),
              testing::HasSubstr("the splits train and test both have the object ball"));
}

}  // namespace outcome_study_test
}  // namespace tacipc
