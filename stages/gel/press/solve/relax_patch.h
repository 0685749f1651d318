// Newton's method for the few vertices that still move.
#pragma once

#include <optional>
#include <vector>

#include "stages/gel/press/solve/collision_detector.h"
#include "stages/gel/press/solve/local_patch.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

class PatchSolver {
 public:
  PatchSolver(const SolverModel& model, CollisionDetector& detector, SolverTimes& times)
      : model_(model), detector_(detector), times_(times), tets_of_(model.gel.tets, model.mesh.num_gel_vertices) {}

  /// If only a few vertices are not yet at rest: Newton's method for the patch of these and their neighbours, all
  /// others held. `pairs`: on entry those within d̂ at the step's x, on return those at its new x, and some more.
  /// \return change of the energy; absent if nothing moved
  std::optional<double> relax(Step& step, const NewtonDirection& direction, std::vector<ContactPair>& pairs);

 private:
  const SolverModel& model_;
  CollisionDetector& detector_;
  SolverTimes& times_;
  TetsOfVertices tets_of_;
};

}  // namespace tacipc
