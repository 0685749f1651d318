// Outcome of a grasp, determined from the object's motion in the hand and from contact; docs/grasp.md.
#pragma once

#include "stages/gel/press/drive/grasp_frame.h"

namespace tacipc {

/// Pose of the object in the hand.
Matrix4 hand_from_object(const GraspFrame& frame);

/// Whether both fingers touch the object or each other.
bool both_touch(const GraspFrame& frame);

/// Whether both_touch() holds, and slip and rotation without creep are below the limits of an outcome.
bool is_held(const GraspFrame& frame);

/// Motion of the object in the hand between two frames.
struct InHand {
  double slip_m = 0.0;    // displacement of its grip point
  double turn_rad = 0.0;  // rotation
};
/// Motion between the frames `then` and `now`. \param grip_m grip point, in the object's axes
InHand motion_in_hand(const GraspFrame& then, const GraspFrame& now, const Vector3& grip_m);

/// Rise of the object's grip point and of the hand between two frames, m.
struct Rise {
  double object_m = 0.0, hand_m = 0.0;
};
Rise rise_of(const GraspFrame& then, const GraspFrame& now, const Vector3& grip_m);

/// Whether any finger touches the object or the other finger.
bool any_touches(const GraspFrame& frame);

/// Outcome between freed_frame and the last frame before the fingers release the object.
/// \pre the frames' slip without creep is computed
GraspOutcome outcome_of(const Grasp& grasp);

}  // namespace tacipc
