// Force and torque on a body, and its velocities.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// The point that the torque is about, and the axes, are said where a wrench is given.
struct Wrench {
  Vector3 force_n, torque_n_m;
};

/// Velocity of a point of a body and the body's angular velocity. Point and axes are said where a twist is given.
struct Twist {
  Vector3 velocity_m_s, spin_rad_s;
};

}  // namespace tacipc
