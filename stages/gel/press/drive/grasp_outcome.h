// What became of a gripped object: by its motion in the hand and by contact alone; docs/grasp.md.
#pragma once

#include "stages/gel/press/drive/grasp_frame.h"

namespace tacipc {

Matrix4 hand_from_object(const GraspFrame& frame);

/// Whether both fingers touch the object (or each other).
bool both_touch(const GraspFrame& frame);

/// Whether they do, and the object has neither slipped nor turned, creep left out, by as much as an outcome wants.
bool is_held(const GraspFrame& frame);

/// How the object has moved in the hand from one frame to another.
struct InHand {
  double slip_m = 0.0;    // of its point at the grip
  double turn_rad = 0.0;  // of it
};
/// \param grip_m that point, in the object's axes
InHand motion_in_hand(const GraspFrame& then, const GraspFrame& now, const Vector3& grip_m);

/// By how much the object's point at the grip has come up, and the hand.
struct Rise {
  double object_m = 0.0, hand_m = 0.0;
};
Rise rise_of(const GraspFrame& then, const GraspFrame& now, const Vector3& grip_m);

/// Whether any finger touches the object, or the other one.
bool any_touches(const GraspFrame& frame);

/// From when it was freed to the last frame before the fingers release it. \pre the frames' slip without creep is known
GraspOutcome outcome_of(const Grasp& grasp);

}  // namespace tacipc
