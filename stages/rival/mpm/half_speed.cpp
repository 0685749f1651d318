#include "stages/rival/mpm/half_speed.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tacipc {

SpeedEffect speed_effect(const std::vector<Positions>& markers, const std::vector<Positions>& at_half_speed) {
  assert(markers.size() == at_half_speed.size() && !markers.empty());
  std::vector<double> difference, displacement;
  double all_difference = 0.0, all_displacement = 0.0;
  for (std::size_t f = 0; f < markers.size(); ++f) {
    difference.push_back((markers[f] - at_half_speed[f]).squaredNorm());
    displacement.push_back((at_half_speed[f] - at_half_speed[0]).squaredNorm());
    all_difference += difference.back();
    all_displacement += displacement.back();
  }
  const double farthest = *std::ranges::max_element(displacement);
  SpeedEffect effect{.change = std::sqrt(all_difference / all_displacement),
                     .last_frame = std::sqrt(difference.back() / displacement.back())};
  for (std::size_t f = 0; f < markers.size(); ++f) {
    if (displacement[f] < 0.01 * farthest) continue;
    const double change = std::sqrt(difference[f] / displacement[f]);
    if (!(change > effect.worst_frame)) continue;
    effect.worst_frame = change;
    effect.worst = f;
  }
  return effect;
}

}  // namespace tacipc
