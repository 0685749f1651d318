// Newton's method for the minimum of a step's incremental potential.
#pragma once

#include "stages/gel/press/solve/lagged_friction.h"
#include "stages/gel/press/solve/move_object.h"
#include "stages/gel/press/solve/relax_patch.h"

namespace tacipc {

/// Minimises the incremental potential of a step.
class Minimiser {
 public:
  /// \param friction updated before iterations while Step::renewals_left is positive
  /// \param times sums over all steps, to which this adds
  Minimiser(const SolverModel& model, CollisionDetector& detector, const LaggedFriction& friction, SolverTimes& times)
      : model_(model),
        detector_(detector),
        friction_(friction),
        times_(times),
        mover_(model, detector),
        patches_(model, detector, times) {}

  /// Moves the objects to their targets and the step's x to the minimum. \throw SolverError if it does not converge
  void minimise(Step& step);

 private:
  /// Newton direction at the step's x; sets the residuals of the step's report.
  /// \param moving objects move to their targets
  NewtonDirection find_direction(Step& step, Minimisation& run, bool moving) const;
  /// Whether the Newton step and the residual forces are below their tolerances.
  bool within_tolerances(const Step& step, const NewtonDirection& direction) const;
  /// Whether a direction within tolerance ends the minimisation. False: iterate further to reach the exact Hessian.
  bool is_final(Step& step, Minimisation& run, const NewtonDirection& direction) const;

  const SolverModel& model_;
  CollisionDetector& detector_;
  const LaggedFriction& friction_;
  SolverTimes& times_;
  ObjectMover mover_;
  PatchSolver patches_;
};

}  // namespace tacipc
