// Friction within a time step: where its normal forces and tangent planes are taken, and how often they are updated.
#pragma once

#include <functional>
#include <memory>

#include "stages/gel/press/solve/collision_detector.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

/// Call start() first, renew() before iterations of Newton's method while Step::renewals_left, settle() from a minimum.
class LaggedFriction {
 public:
  LaggedFriction(const SolverModel& model, CollisionDetector& detector) : model_(model), detector_(detector) {}

  /// Gives the step the friction that its first minimum is sought with, if there is any.
  void start(Step& step);
  /// Friction and the energy with normal forces and tangent planes at the step's x.
  void renew(Step& step, Minimisation& run) const;
  /// Updates friction and minimises again until friction belongs to its own contact forces.
  /// \throw SolverError if it does not settle
  void settle(Step& step, const std::function<void()>& minimise);

 private:
  /// Friction of this step with normal forces and tangent planes at x. \pre there is friction
  std::shared_ptr<const Friction> lagged_at(const Positions& x, ActiveBarrier& barrier, const Step& step) const;
  std::shared_ptr<const Friction> lagged_at(const Positions& x, const Step& step);
  /// Σ over free vertices and free bodies of |force| by which other friction would differ from that of the step, at its
  /// x.
  double change(const Friction& renewed, const Step& step) const;
  /// Largest such change at the end of a step.
  double limit(const Step& step) const;

  const SolverModel& model_;
  CollisionDetector& detector_;
};

}  // namespace tacipc
