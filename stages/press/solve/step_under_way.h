// One time step under way: what the files that solve it share.
#pragma once

#include <memory>

#include "stages/press/energy/dirichlet.h"
#include "stages/press/solve/time_step.h"

namespace tacipc {

struct TimeStepper::Step {
  const StepGoal& goal;
  const IterationObserver& observe;
  const Positions& start;  // of gel and object
  Positions x;
  StepTerms terms = {};  // all but the barrier
  StepWeights weights = {};
  bool arrived = false;
  Vector3 yield = Vector3::Zero();
  StepReport report = {};
  std::shared_ptr<const Friction> friction = nullptr;
  std::shared_ptr<const Dirichlet> constraint = nullptr;
  Blend blend;             // of NewtonStepper::direction, once the object has arrived
  double looseness = 1.0;  // of the tolerances, while friction is still to be renewed
};

/// A step p turned out to be too long for the energy: those that went far are the likely cause.
void lean_on_farthest(const Positions& p, Blend& blend);

inline constexpr double kGapFloor = 1e-4;    // × d̂
inline constexpr double kNewtonSlack = 0.1;  // part of each gap that a step leaves

}  // namespace tacipc
