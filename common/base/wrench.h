// Force and torque on a body, and its velocities.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// Force and torque. Axes and the reference point of the torque are stated where a wrench is used.
struct Wrench {
  Vector3 force_n, torque_n_m;
};

/// Velocity of a point of a body, and the body's angular velocity. Point and axes are stated where a twist is used.
struct Twist {
  Vector3 velocity_m_s, spin_rad_s;
};

}  // namespace tacipc
