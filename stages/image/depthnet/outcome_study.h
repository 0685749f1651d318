// How well a network foretells what becomes of grasps of unseen objects, beside what knows less.
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
  bool shuffled = false;  // a control: the outcomes of the training were exchanged among its grasps
  std::vector<LearntEpoch> history = {};
  std::vector<double> probabilities = {};  // of the test grasps

  /// "network_1", "shuffled_1"
  std::string name() const;
};

struct OutcomeStudy {
  std::vector<GraspItem> train, val, test;
  std::vector<OutcomeTraining> trainings;  // by seed, the network before its control
  torch::jit::Module network;              // of the first seed
  GripBaseline baseline;                   // fitted to `train`
  std::vector<double> grip_only;           // its probabilities of the test grasps
};

/// Trains each seed's network and control on the split `train` and asks them about `test`; no seed is chosen by it.
/// `checkpoints` are those of a training of that name. \throw DataError if the split `train` or `test` has no grasps,
/// only held ones or none, or if they have an object in common
OutcomeStudy study_outcomes(std::vector<GraspItem> items, const OutcomeConfig& config,
                            const std::function<Checkpoints(const std::string&)>& checkpoints);

}  // namespace tacipc
