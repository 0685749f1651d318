// Whether the object moves slowly enough for the gel to follow: what half the speed changes.
#pragma once

#include <cstddef>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

struct SpeedEffect {
  double change =
      0.0;  // √(Σ |u − u′|² / Σ |u′|²) over all markers and frames: u displacement since rest, u′ at half speed
  double last_frame = 0.0;   // the same over the last frame alone
  double worst_frame = 0.0;  // the largest of any frame in which the markers have gone a tenth of their farthest
  std::size_t worst = 0;     // which that is
};

/// Markers in every frame, m. \pre the same frames and markers; frame 0 is at rest and some frame is not
SpeedEffect speed_effect(const std::vector<Positions>& markers, const std::vector<Positions>& at_half_speed);

}  // namespace tacipc
