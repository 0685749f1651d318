// Motion of a held object in the hand since it was freed, and the part of it that is creep.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// Slip share from which a contact slips as a whole: fraction of a finger's normal force on vertices that slip.
inline constexpr double kGrossSlipShare = 0.95;

/// Contact of the fingers with a held object in one frame, and the time since the frame before.
struct HeldContact {
  double seconds = 0.0;     // time since the frame before
  double slip_share = 0.0;  // fraction of the finger's normal force on slipping vertices: the largest of all fingers
  double radius_m = 0.0;    // mean distance of a finger's normal force from its centre, ρ: the largest of all fingers
};

/// Follows an object frame by frame. The motion between two frames is creep if no finger slips as a whole, and neither
/// the grip point nor the contact about it moves faster than the speed ε_v below which friction sticks:
///   slip share < 0.95,  |Δp| ≤ ε_v Δt,  ρ Δφ ≤ ε_v Δt.
/// Smoothed friction bears any load inside its cone at some speed below ε_v, so that a stable grasp creeps as long as
/// it lasts. The total displacement without these parts is slip.
class HeldPath {
 public:
  /// \param hand_from_object pose when the object was freed
  /// \param grip_m grip point, in the object's axes
  /// \param slip_speed_m_s ε_v
  HeldPath(const Matrix4& hand_from_object, const Vector3& grip_m, double slip_speed_m_s);

  /// Adds the next frame.
  void go_on(const Matrix4& hand_from_object, const HeldContact& contact);

  // Net motion since the start: in total, by creep, and by slip (the total without creep).
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
