// Evaluates how well a network predicts the outcome of grasps of unseen objects, compared with a control and a
// baseline.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "stages/image/depthnet/grasp_set.h"
#include "stages/image/depthnet/grip_baseline.h"
#include "stages/image/depthnet/learn.h"
#include "stages/image/depthnet/outcome_network.h"

namespace tacipc {

std::vector<bool> held_of(const std::vector<GraspItem>& items);
std::set<std::string> objects_of(const std::vector<GraspItem>& items);

/// One training.
struct OutcomeTraining {
  std::uint64_t seed = 0;
  bool shuffled = false;  // control: outcomes were permuted among the grasps of the training
  std::vector<LearntEpoch> history = {};
  std::vector<double> probabilities = {};  // probabilities of the test grasps

  /// Name such as "network_1" or "shuffled_1".
  std::string name() const;
};

/// Grasps, trainings and baseline of a study.
struct OutcomeStudy {
  std::vector<GraspItem> train, val, test;
  std::vector<OutcomeTraining> trainings;  // trainings by seed, each network before its control
  torch::jit::Module network;              // network of the first seed
  GripBaseline baseline;                   // fitted to `train`
  std::vector<double> grip_only;           // baseline probabilities of the test grasps
};

/// Trains each seed's network and control on the split `train` and evaluates them on `test`, which selects no seed.
/// \param checkpoints checkpoints for the training of a given name
/// \throw DataError if the split `train` or `test` has no grasps, only held ones or none held, or if they share an
/// object
OutcomeStudy study_outcomes(std::vector<GraspItem> items, const OutcomeConfig& config,
                            const std::function<Checkpoints(const std::string&)>& checkpoints);

}  // namespace tacipc
