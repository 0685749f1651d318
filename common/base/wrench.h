// Force and torque on a body.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// The point that the torque is about, and the axes, are said where a wrench is given.
struct Wrench {
  Vector3 force_n, torque_n_m;
};

}  // namespace tacipc
