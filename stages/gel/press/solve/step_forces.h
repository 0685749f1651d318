// Forces at the end of a time step.
#pragma once

#include <memory>

#include "stages/gel/press/solve/collision_detector.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

/// Forces on a gel without contact: all zero.
StepForces no_forces(int num_gel_vertices);

/// Computes the forces of a solved step.
class ForceReport {
 public:
  ForceReport(const SolverModel& model, CollisionDetector& detector);

  /// Forces at the positions `step.x`.
  StepForces at_end_of(const Step& step);

 private:
  const SolverModel& model_;
  CollisionDetector& detector_;
  std::shared_ptr<const EnergyTerm> elasticity_at_mount_;  // stencils with a glued vertex, for mount forces
};

}  // namespace tacipc
