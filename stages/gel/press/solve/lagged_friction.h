// Lagged friction within a time step: where its normal forces and tangent planes are computed, and how often they are
// updated.
#pragma once

#include <functional>
#include <memory>

#include "stages/gel/press/solve/collision_detector.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

/// Call order: start() at the start of the step, renew() before Newton iterations while Step::renewals_left is
/// positive, settle() at a minimum.
class LaggedFriction {
 public:
  LaggedFriction(const SolverModel& model, CollisionDetector& detector) : model_(model), detector_(detector) {}

  /// Sets the friction of the first minimisation, if the settings have friction.
  void start(Step& step);
  /// Updates friction and energy to the normal forces and tangent planes at the step's x.
  void renew(Step& step, Minimisation& run) const;
  /// Updates friction and minimises again until friction matches its own contact forces.
  /// \throw SolverError if it does not settle
  void settle(Step& step, const std::function<void()>& minimise);

 private:
  /// Friction of this step with normal forces and tangent planes at x. \pre there is friction
  std::shared_ptr<const Friction> lagged_at(const Positions& x, ActiveBarrier& barrier, const Step& step) const;
  std::shared_ptr<const Friction> lagged_at(const Positions& x, const Step& step);
  /// Σ |force difference| between `renewed` and the step's friction, over free vertices and free bodies, at the step's
  /// x.
  double change(const Friction& renewed, const Step& step) const;
  /// Largest change() with which a step may end.
  double limit(const Step& step) const;

  const SolverModel& model_;
  CollisionDetector& detector_;
};

}  // namespace tacipc
