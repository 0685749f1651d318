// Newton's method on a patch: the few vertices that still move.
#pragma once

#include <optional>
#include <vector>

#include "stages/gel/press/solve/collision_detector.h"
#include "stages/gel/press/solve/local_patch.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

/// Solves patches between the iterations of a step.
class PatchSolver {
 public:
  PatchSolver(const SolverModel& model, CollisionDetector& detector, SolverTimes& times)
      : model_(model), detector_(detector), times_(times), tets_of_(model.gel.tets, model.mesh.num_gel_vertices) {}

  /// If only a few vertices still move, runs Newton's method on them and their neighbours with all others fixed.
  /// \param pairs on entry the pairs within d̂ at the step's x, on return those within d̂ at the new x (or a superset)
  /// \return change of the energy; nothing if no vertex moved
  std::optional<double> relax(Step& step, const NewtonDirection& direction, std::vector<ContactPair>& pairs);

 private:
  const SolverModel& model_;
  CollisionDetector& detector_;
  SolverTimes& times_;
  TetsOfVertices tets_of_;
};

}  // namespace tacipc
