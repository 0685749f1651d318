// Moves of objects on their way to their targets, together with the gel.
#pragma once

#include <vector>

#include "stages/gel/press/solve/collision_detector.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

class ObjectMover {
 public:
  ObjectMover(const SolverModel& model, CollisionDetector& detector) : model_(model), detector_(detector) {}

  /// If single contacts would end a move early: shortens the direction to the part that a few small corrections allow,
  /// and makes these, by which the contacts keep a part of their gaps. `pairs`: on entry the pairs along the direction,
  /// on return those along the new one.
  /// \return the part of that direction that may be taken
  double bend_at_contacts(const Step& step, Minimisation& run, NewtonDirection& direction,
                          std::vector<ContactPair>& pairs);

  /// Moves objects and gel together by the part `alpha` of the direction.
  void move(Step& step, Minimisation& run, const NewtonDirection& direction, double alpha) const;

 private:
  /// Corrects the direction at its limiting pairs, a few times. \return whether it did
  /// \param limiting pairs that limited the direction before it was shortened
  bool correct_direction(const Step& step, std::vector<ContactPair> limiting, const std::vector<ContactPair>& pairs,
                         NewtonDirection& direction);

  const SolverModel& model_;
  CollisionDetector& detector_;
};

}  // namespace tacipc
