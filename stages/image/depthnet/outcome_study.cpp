#include "stages/image/depthnet/outcome_study.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "common/base/each_in_threads.h"
#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/rng.h"
#include "stages/image/depthnet/augment.h"

namespace tacipc {
namespace {

constexpr std::uint64_t kOutcomeStream = 3;

torch::Tensor logit_of(const torch::jit::Module& network, const torch::Tensor& input) {
  return network.get_method("logit")({input}).toTensor();
}

/// Fraction of the grasps whose probability is on the right side of ½.
double share_right(const std::vector<double>& probabilities, const std::vector<GraspItem>& items) {
  double right = 0.0;
  for (std::size_t i = 0; i < items.size(); ++i) right += (probabilities[i] >= 0.5) == items[i].held;
  return items.empty() ? std::numeric_limits<double>::quiet_NaN() : right / static_cast<double>(items.size());
}

/// The network's probability that each grasp holds.
std::vector<double> probabilities_of(const torch::jit::Module& network, const std::vector<GraspItem>& items) {
  std::vector<double> probabilities(items.size());
  each_in_threads(items.size(), [&](std::size_t i) {
    stay_in_this_thread();
    const torch::NoGradGuard no_gradients;
    const torch::Tensor seen = torch::cat({items[i].fingers[0], items[i].fingers[1]}).to(torch::kFloat);
    probabilities[i] = torch::sigmoid(logit_of(network, seen)).item<double>();
  });
  return probabilities;
}

/// Trains the weights in place on grasps and their labels `held`. The loss is the logistic one. In every epoch each
/// grasp is augmented anew, and its fingers are exchanged or not: half a turn about the vertical maps one finger to the
/// other.
/// \return the epochs; `judged` holds the accuracy on the training's labels and on the validation (NaN without any)
std::vector<LearntEpoch> train_outcome(torch::jit::Module& network, const std::vector<GraspItem>& items,
                                       const std::vector<bool>& held, const std::vector<GraspItem>& validation,
                                       const OutcomeConfig& config, std::uint64_t seed, const Checkpoints& checkpoints,
                                       const std::string& name) {
  const auto answer = [&](int epoch, std::size_t index) -> Lesson::Answer {
    const bool exchanged =
        (random_bits(seed, mix_bits(hash_of("side") + index), static_cast<std::uint64_t>(epoch)) & 1) != 0;
    torch::Tensor seen[2];
    for (std::size_t f = 0; f < 2; ++f)
      seen[exchanged ? 1 - f : f] =
          disturbed(items[index].fingers[f], {}, config.augmentation, seed, epoch, 2 * index + f).input;
    const torch::Tensor logit = logit_of(network, torch::cat({seen[0], seen[1]}));
    return {.loss = torch::binary_cross_entropy_with_logits(logit, torch::full_like(logit, held[index] ? 1.0 : 0.0)),
            .sums = {(logit.item<float>() >= 0.0F) == held[index] ? 1.0 : 0.0}};
  };
  const auto judged = [&](int epoch, double loss, const std::vector<double>& sums) -> std::vector<double> {
    const double right = sums[0] / static_cast<double>(items.size());
    const double validated = share_right(probabilities_of(network, validation), validation);
    log_debug("{}, epoch {}: loss {:.4f}, right {:.3f}, of the validation {:.3f}", name, epoch, loss, right, validated);
    return {right, validated};
  };
  return learn(weights_of(network), {items.size(), answer, judged}, config.schedule, seed, checkpoints, name);
}

std::vector<double> grips_of(const std::vector<GraspItem>& items) {
  std::vector<double> grips_n;
  for (const GraspItem& item : items) grips_n.push_back(item.grip_n);
  return grips_n;
}

void check(const std::vector<GraspItem>& items, const std::string& split) {
  const std::vector<bool> held = held_of(items);
  const auto lifted = static_cast<std::size_t>(std::ranges::count(held, true));
  if (items.empty())
    throw DataError("the split {} has no grasps: the dataset needs grasps of more objects, and `splits`", split);
  if (lifted == 0 || lifted == items.size())
    throw DataError("the split {} has {} grasps of {} objects, {} held: there is nothing to tell apart", split,
                    items.size(), objects_of(items).size(), lifted == 0 ? "none" : "all");
}

}  // namespace

std::string OutcomeTraining::name() const { return fmt::format("{}_{}", shuffled ? "shuffled" : "network", seed); }

std::set<std::string> objects_of(const std::vector<GraspItem>& items) {
  std::set<std::string> objects;
  for (const GraspItem& item : items) objects.insert(item.object);
  return objects;
}

std::vector<bool> held_of(const std::vector<GraspItem>& items) {
  std::vector<bool> held;
  for (const GraspItem& item : items) held.push_back(item.held);
  return held;
}

OutcomeStudy study_outcomes(std::vector<GraspItem> items, const OutcomeConfig& config,
                            const std::function<Checkpoints(const std::string&)>& checkpoints) {
  OutcomeStudy study;
  for (GraspItem& item : items) {
    const auto& split = item.split;
    (split == "train" ? study.train : split == "val" ? study.val : study.test).push_back(std::move(item));
  }
  check(study.train, "train");
  check(study.test, "test");
  const std::set<std::string> trained = objects_of(study.train);
  for (const std::string& object : objects_of(study.test))
    if (trained.contains(object)) throw DataError("the splits train and test both have the object {}", object);
  log_info("{} grasps of {} objects to train on, {} of {} to judge by", study.train.size(), trained.size(),
           study.test.size(), objects_of(study.test).size());
  const std::vector<bool> held = held_of(study.train);
  study.baseline = fit_grip_baseline(grips_of(study.train), held);
  for (const GraspItem& item : study.test) study.grip_only.push_back(study.baseline.probability(item.grip_n));
  for (int k = 0; k < config.seeds; ++k)
    for (const bool shuffled : {false, true}) {
      OutcomeTraining training{.seed = config.seed + static_cast<std::uint64_t>(k), .shuffled = shuffled};
      std::vector<bool> taught = held;
      if (shuffled) {
        const std::vector<std::size_t> order = random_order(held.size(), training.seed, kOutcomeStream, 0);
        for (std::size_t i = 0; i < order.size(); ++i) taught[i] = held[order[i]];
      }
      torch::jit::Module network = make_outcome_network(config, training.seed);
      training.history = train_outcome(network, study.train, taught, study.val, config, training.seed,
                                       checkpoints(training.name()), training.name());
      training.probabilities = probabilities_of(network, study.test);
      log_info("{}: loss {:.4f}, {:.3f} of the test right", training.name(), training.history.back().loss,
               share_right(training.probabilities, study.test));
      if (k == 0 && !shuffled) study.network = network;
      study.trainings.push_back(std::move(training));
    }
  return study;
}

}  // namespace tacipc
