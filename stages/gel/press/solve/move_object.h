// Moves objects towards their targets, together with the gel.
#pragma once

#include <vector>

#include "stages/gel/press/solve/collision_detector.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

/// Moves objects and gel along a Newton direction.
class ObjectMover {
 public:
  ObjectMover(const SolverModel& model, CollisionDetector& detector) : model_(model), detector_(detector) {}

  /// If single contacts would end a move early, shortens the direction to the fraction that a few small corrections
  /// allow, and applies these corrections. The contacts then keep a part of their gaps.
  /// \param pairs on entry the pairs along the direction, on return the pairs along the new direction
  /// \return fraction of the new direction that may be taken
  double bend_at_contacts(const Step& step, Minimisation& run, NewtonDirection& direction,
                          std::vector<ContactPair>& pairs);

  /// Moves objects and gel together by the fraction `alpha` of the direction.
  void move(Step& step, Minimisation& run, const NewtonDirection& direction, double alpha) const;

 private:
  /// Corrects the direction a few times at its limiting pairs.
  /// \return whether it changed
  /// \param limiting pairs that limited the direction before it was shortened
  bool correct_direction(const Step& step, std::vector<ContactPair> limiting, const std::vector<ContactPair>& pairs,
                         NewtonDirection& direction);

  const SolverModel& model_;
  CollisionDetector& detector_;
};

}  // namespace tacipc
