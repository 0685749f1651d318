#include "common/sample/held_path.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace tacipc {
namespace {

double angle(const Matrix3& rotation) { return Eigen::AngleAxisd(rotation).angle(); }

}  // namespace

HeldPath::HeldPath(const Matrix4& hand_from_object, const Vector3& grip_m, double slip_speed_m_s)
    : grip_m_(grip_m),
      start_(point(hand_from_object)),
      at_(start_),
      first_(hand_from_object.topLeftCorner<3, 3>()),
      turned_(first_),
      slip_speed_m_s_(slip_speed_m_s) {}

Vector3 HeldPath::point(const Matrix4& hand_from_object) const {
  return hand_from_object.topLeftCorner<3, 3>() * grip_m_ + hand_from_object.topRightCorner<3, 1>();
}

void HeldPath::go_on(const Matrix4& hand_from_object, const HeldContact& contact) {
  const Vector3 at = point(hand_from_object), moved = at - at_;
  const Matrix3 turned = hand_from_object.topLeftCorner<3, 3>(), turn = turned * turned_.transpose();
  at_ = at;
  turned_ = turned;
  const double fastest_m = std::max(moved.norm(), contact.radius_m * angle(turn));
  if (contact.slip_share >= kGrossSlipShare || fastest_m > slip_speed_m_s_ * contact.seconds) return;
  crept_ += moved;
  turned_by_creep_ = turn * turned_by_creep_;
}

double HeldPath::turn_rad() const { return angle(turned_ * first_.transpose()); }
double HeldPath::creep_rad() const { return angle(turned_by_creep_); }
double HeldPath::slip_rad() const { return angle(turned_ * first_.transpose() * turned_by_creep_.transpose()); }

}  // namespace tacipc
