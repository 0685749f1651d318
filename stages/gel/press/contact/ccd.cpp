#include "stages/gel/press/contact/ccd.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "stages/gel/press/contact/pair_motion.h"

namespace tacipc {
namespace {

/// A pair this close to the wanted separation (relative) is not moved further.
constexpr double kCloseEnough = 1e-2;
/// Factor on the interval after each failed attempt at a longer one.
constexpr double kShrink = 0.25;
constexpr int kMaxCuts = 24;
/// Largest number of certified steps; then the time reached is returned.
constexpr int kMaxSteps = 200;

}  // namespace

double time_of_impact(ContactPair::Kind kind, const FourPoints& x, const FourPoints& displacement, double slack) {
  assert(slack >= 0 && slack < 1);
  const PairMotion motion(kind, x, displacement);
  const ClosestFeature start = motion.closest(0);
  const double separation = slack * std::sqrt(start.squared_distance);
  std::optional<Vector3> n = motion.direction(start);
  double t = 0;
  double reach = 1;  // length of the next interval
  for (int step = 0; n && step < kMaxSteps; ++step) {
    // A fixed plane through the gap takes most pairs to the end in one step, and the others by a Newton step towards
    // the impact.
    const double exit = motion.gap_exit(t, *n, separation);
    if (exit == 1) return 1;
    if (!(motion.gap(t, *n) > (1 + kCloseEnough) * separation)) return t;

    // A longer interval, with a plane that rotates with the pair or with the volume.
    bool longer = false;
    double to = std::min(1.0, t + reach);
    for (int tries = 0; to > exit && tries < kMaxCuts; ++tries, to = t + kShrink * (to - t)) {
      const std::optional<Vector3> n_to = motion.direction(motion.closest(to));
      if (!n_to) continue;
      if (motion.plane_separates(t, to, *n, *n_to, separation) ||
          motion.plane_separates(t, to, *n_to, *n_to, separation) || motion.volume_separates(t, to, separation)) {
        longer = true;
        n = n_to;
        break;
      }
    }
    if (!longer && exit == t) return t;
    if (!longer) {
      to = exit;
      n = motion.direction(motion.closest(exit));
    }
    if (to == 1) return 1;
    reach = (to - t) / kShrink / kShrink;
    t = to;
  }
  return t;
}

}  // namespace tacipc
