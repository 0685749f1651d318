// One implicit time step: moves objects to their prescribed poses, then finds the equilibrium of everything that is
// free by minimising the incremental potential.
//
// Order of a step (TimeStepper::advance):
//   1. start_step() builds the energy terms, displaces gels with their mounts and free bodies along their flight, and
//      sets up friction.
//   2. Minimiser::minimise() moves the objects and the gel together, then runs projected Newton.
//   3. LaggedFriction::settle() updates friction until it matches the final contact forces.
//   4. finish_step() writes velocities, forces and the report.
// If a step fails and a gap is nearly closed, advance() repeats it with a stiffer barrier.
//
// Vocabulary: "held" objects have a prescribed pose; "free" bodies move by weight, load and contact; a "mount" is the
// part to which the glued face of a gel is fixed; a "patch" is a small set of vertices that is solved for alone.
#pragma once

#include <map>
#include <memory>

#include "stages/gel/press/solve/minimise.h"
#include "stages/gel/press/solve/step_forces.h"

namespace tacipc {

/// Advances the state of a simulation step by step.
class TimeStepper {
 public:
  /// \param bodies the leading objects of the mesh that may be free; the mesh has rows for their control points
  /// \pre the mesh outlives the stepper and keeps its address
  TimeStepper(const ContactMesh& mesh, GelModel gel, const StepSettings& settings, std::vector<AffineBody> bodies = {});
  TimeStepper(const TimeStepper&) = delete;
  TimeStepper& operator=(const TimeStepper&) = delete;

  /// Advances the state by one step. Held objects end bit-equal to their targets, except along free axes and unless an
  /// augmented Lagrangian holds them.
  /// \throw SolverError with the numbers if the step does not converge; only State::barrier_factor may then have
  /// changed
  StepReport advance(State& state, const StepGoal& goal, const IterationObserver& observe);

  /// Forces at the end of the last successful step.
  const StepForces& forces() const { return forces_; }
  /// Smallest gap between two bodies of which at least one can move by itself, capped at `none`. Gaps within a gel do
  /// not count.
  double smallest_gap(const Positions& x, double none) { return detector_.smallest_gap(x, none); }
  /// Solver time and work since construction.
  SolverTimes times() const;

 private:
  /// Sets up the step: energy terms, weights, initial displacement and friction.
  Step start_step(const State& state, const StepGoal& goal, const IterationObserver& observe);
  /// Writes the forces of a solved step, and its positions and velocities into the state.
  void finish_step(Step& step, State& state);
  /// Stiffens the barrier of the following steps if a gap at x is too small. \return whether it did
  bool stiffen_barrier(State& state, const Positions& x);
  /// Newton stepper for this set of free bodies, created on first use.
  NewtonStepper& stepper(const std::vector<int>& free_bodies);

  const SolverModel model_;
  SolverTimes times_;
  CollisionDetector detector_;
  LaggedFriction friction_;
  Minimiser minimiser_;
  ForceReport force_report_;
  std::map<std::vector<int>, std::unique_ptr<NewtonStepper>> steppers_;  // keyed by the set of free bodies
  StepForces forces_;
};

}  // namespace tacipc
