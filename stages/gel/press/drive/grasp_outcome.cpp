#include "stages/gel/press/drive/grasp_outcome.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace tacipc {
Matrix4 hand_from_object(const GraspFrame& frame) {
  const Matrix3 to_hand = frame.world_from_hand.topLeftCorner<3, 3>().transpose();
  Matrix4 pose = Matrix4::Identity();
  pose.topLeftCorner<3, 3>() = to_hand * frame.world_from_object.topLeftCorner<3, 3>();
  pose.topRightCorner<3, 1>() = to_hand * (frame.world_from_object - frame.world_from_hand).topRightCorner<3, 1>();
  return pose;
}

namespace {

Vector3 at(const Matrix4& from_object, const Vector3& point_m) {
  return from_object.topLeftCorner<3, 3>() * point_m + from_object.topRightCorner<3, 1>();
}

}  // namespace

InHand motion_in_hand(const GraspFrame& then, const GraspFrame& now, const Vector3& grip_m) {
  const Matrix4 before = hand_from_object(then), after = hand_from_object(now);
  return {(at(after, grip_m) - at(before, grip_m)).norm(),
          Eigen::AngleAxisd(Matrix3(after.topLeftCorner<3, 3>() * before.topLeftCorner<3, 3>().transpose())).angle()};
}

bool both_touch(const GraspFrame& frame) {
  return frame.force_on_finger_n[0].norm() > kTouches_n && frame.force_on_finger_n[1].norm() > kTouches_n;
}

bool is_held(const GraspFrame& frame) {
  return both_touch(frame) && frame.slid_m < kSlipped_m && frame.slid_rad < kTurned_rad;
}

Rise rise_of(const GraspFrame& then, const GraspFrame& now, const Vector3& grip_m) {
  return {(at(now.world_from_object, grip_m) - at(then.world_from_object, grip_m)).z(),
          (now.world_from_hand - then.world_from_hand)(2, 3)};
}

bool any_touches(const GraspFrame& frame) {
  return frame.force_on_finger_n[0].norm() > kTouches_n || frame.force_on_finger_n[1].norm() > kTouches_n;
}

GraspOutcome outcome_of(const Grasp& grasp) {
  const GraspFrame &begin = grasp.frames[grasp.freed_frame], &end = grasp.frames[grasp.judged_frame];
  const auto [rose, hand] = rise_of(begin, end, grasp.grip_point());
  return outcome_of({.ever_touched = std::any_of(grasp.frames.begin(), grasp.frames.end(), any_touches),
                     .touched = both_touch(end),
                     .slip_m = end.slid_m,
                     .turn_rad = end.slid_rad,
                     .rise_m = rose,
                     .hand_rise_m = hand});
}

}  // namespace tacipc
