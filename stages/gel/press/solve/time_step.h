// One time step: brings objects to their prescribed poses and all else to the minimum of the incremental potential.
#pragma once

#include <map>
#include <memory>

#include "stages/gel/press/solve/minimise.h"
#include "stages/gel/press/solve/step_forces.h"

namespace tacipc {

class TimeStepper {
 public:
  /// \param bodies the first objects, those that may be free: the mesh then has rows for their points
  /// \pre the mesh stays where it is
  TimeStepper(const ContactMesh& mesh, GelModel gel, const StepSettings& settings, std::vector<AffineBody> bodies = {});
  TimeStepper(const TimeStepper&) = delete;
  TimeStepper& operator=(const TimeStepper&) = delete;

  /// Advances the state by one step. But for free axes, objects that are not free end bit-equal to the target.
  /// \throw SolverError with the numbers if the step does not converge; the state is then as before but for the
  /// barrier's factor.
  StepReport advance(State& state, const StepGoal& goal, const IterationObserver& observe);

  /// Forces at the end of the last step that succeeded.
  const StepForces& forces() const { return forces_; }
  /// Smallest gap between two bodies, one of which can move by itself (not counting a gel with itself), at most `none`.
  double smallest_gap(const Positions& x, double none) { return detector_.smallest_gap(x, none); }
  /// Solver time and work since construction.
  SolverTimes times() const;

 private:
  /// The step before its first iteration: terms, weights, friction.
  Step start_step(const State& state, const StepGoal& goal, const IterationObserver& observe);
  /// Takes a solved step over into the state.
  void finish_step(Step& step, State& state);
  /// Makes the barrier of the next steps stiffer if a gap at x is too small; true if it did.
  bool stiffen_barrier(State& state, const Positions& x);
  /// The stepper for a step in which these bodies are free.
  NewtonStepper& stepper(const std::vector<int>& free_bodies);

  const SolverModel model_;
  SolverTimes times_;
  CollisionDetector detector_;
  LaggedFriction friction_;
  Minimiser minimiser_;
  ForceReport force_report_;
  std::map<std::vector<int>, std::unique_ptr<NewtonStepper>> steppers_;  // by the bodies that are free
  StepForces forces_;
};

}  // namespace tacipc
