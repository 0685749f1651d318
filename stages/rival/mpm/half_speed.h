// Tests whether the object moves slowly enough for the gel to follow: the change at half the speed.
#pragma once

#include <cstddef>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// Change of the markers at half the speed.
struct SpeedEffect {
  double change =
      0.0;  // √(Σ |u − u′|² / Σ |u′|²) over all markers and frames: u displacement since rest, u′ at half speed
  double last_frame = 0.0;  // this ratio over the last frame alone
  double worst_frame =
      0.0;  // largest ratio of any frame in which the markers have moved at least a tenth of their largest displacement
  std::size_t worst = 0;  // index of that frame
};

/// Compares the markers of both runs in every frame, m.
/// \pre the same frames and markers; frame 0 is at rest and some frame is not
SpeedEffect speed_effect(const std::vector<Positions>& markers, const std::vector<Positions>& at_half_speed);

}  // namespace tacipc
