// The way of a held object in the hand: how far it has moved since it was freed, and how much of that it only crept.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// Share of a finger's normal force on vertices that slip from which its contact slips as a whole.
inline constexpr double kGrossSlipShare = 0.95;

/// Contact of the fingers with a held object in one frame, and the time since the frame before.
struct HeldContact {
  double seconds = 0.0;
  double slip_share = 0.0;  // of the finger's normal force on vertices that slip: the largest of all fingers
  double radius_m = 0.0;    // mean distance of a finger's normal force from its centre: the largest of all fingers
};

/// Follows an object frame by frame. Between two frames it creeps where no finger slips as a whole and neither its
/// point at the grip nor the contact about that goes faster than the speed ε_v below which friction sticks:
///   slip share < 0.95,  |Δp| ≤ ε_v Δt,  ρ Δφ ≤ ε_v Δt.
/// Smoothed friction bears any load inside its cone at some speed below ε_v, so that a grasp that holds creeps as long
/// as it lasts. What is left of its way without these parts is slip.
class HeldPath {
 public:
  /// \param hand_from_object when it was freed \param grip_m the point at the grip, in the object's axes
  HeldPath(const Matrix4& hand_from_object, const Vector3& grip_m, double slip_speed_m_s);

  /// The next frame.
  void go_on(const Matrix4& hand_from_object, const HeldContact& contact);

  // Net motion since the start: all of it, the part that it crept, and what is left without that part.
  double way_m() const { return (at_ - start_).norm(); }
  double turn_rad() const;
  double creep_m() const { return crept_.norm(); }
  double creep_rad() const;
  double slip_m() const { return (at_ - start_ - crept_).norm(); }
  double slip_rad() const;

 private:
  Vector3 point(const Matrix4& hand_from_object) const;

  Vector3 grip_m_, start_, at_, crept_ = Vector3::Zero();
  Matrix3 first_, turned_, turned_by_creep_ = Matrix3::Identity();
  double slip_speed_m_s_;
};

}  // namespace tacipc
