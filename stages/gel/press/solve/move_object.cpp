// Within a time step: moving the object on its way, together with the gel.
#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/log.h"
#include "stages/gel/press/solve/step_limit.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {
namespace {

// Contacts are corrected by at most the first, a few of them by the second, × d̂.
constexpr double kCorrection = 0.3, kLargestCorrection = 1.0;
constexpr std::size_t kLargeCorrections = 3;
constexpr double kSpare = 0.1;  // a correction may grow by this part of the most while others are made
constexpr int kRounds = 3;
// Part of its gap, at most d̂, that a corrected contact keeps at least: a little more than a move has to leave.
constexpr double kKeptGap = 1.03 * kMovingSlack;
// A corrected move of which less than this may be made is compared with the one without corrections.
constexpr double kPoorMove = 0.5;
// After a move as long as wanted the next one goes so many times as far; after less than this part of one, the gel is
// relaxed first.
constexpr double kGrowth = 2.0, kShortMove = 0.1;
constexpr double kSmallestPart = 1e-3;  // of the rest of the object's motion that a move aims at

/// How a pair's gap changes in a move, to first order: the normal stays.
struct Approach {
  ClosestFeature feature;
  Vector3 normal;
  double gap_m, change_m;
  double give = 0.0;  // Σ weight² over the gel's free vertices: what they do about it together
};

/// Corrections of one vertex, weighted by its part in their pairs.
struct Given {
  Vector3 sum = Vector3::Zero();
  double weight = 0.0;
};

}  // namespace

double TimeStepper::bend_at_contacts(const Step& step, Minimisation& run, NewtonDirection& direction,
                                     std::vector<ContactPair>& pairs) {
  const double touching_m = settings_.laws.reach_m();
  const GapRule rule = gap_rule(kMovingSlack);
  const auto approach = [&](const ContactPair& pair) {
    Approach a{.feature = closest_feature(pair, gather(step.x, pair)), .normal = {}, .gap_m = 0.0, .change_m = 0.0};
    a.gap_m = std::sqrt(a.feature.squared_distance);
    a.normal = a.feature.r / a.gap_m;
    for (int k = 0; k < 4; ++k) {
      const int v = pair.vertices[k];
      a.change_m += a.feature.weights[k] * a.normal.dot(direction.p.row(v));
      if (newton_->free().free_of_vertex[v] >= 0) a.give += a.feature.weights[k] * a.feature.weights[k];
    }
    return a;
  };
  const auto limiting = [&](const std::vector<ContactPair>& among) {
    const Stopwatch watch(times_.limits_s);
    return limiting_pairs(among, step.x, direction.p, rule);
  };

  std::vector<ContactPair> found = limiting(pairs);
  if (found.empty()) return step_limit(pairs, step, direction.p, kMovingSlack);
  double part = 1.0;
  std::vector<double> parts;
  for (const ContactPair& pair : found) {
    const Approach a = approach(pair);
    if (!(a.change_m < 0.0)) continue;
    const double kept = kKeptGap * std::min(a.gap_m, touching_m), most = a.give > 0.0 ? touching_m : 0.0;
    part = std::min(part, (a.gap_m + kLargestCorrection * most - kept) / -a.change_m);
    parts.push_back((a.gap_m + kCorrection * most - kept) / -a.change_m);
  }
  if (parts.size() > kLargeCorrections) {
    std::nth_element(parts.begin(), parts.begin() + kLargeCorrections, parts.end());
    part = std::min(part, parts[kLargeCorrections]);
  }
  const NewtonDirection straight = direction;
  direction.p *= part;
  direction.object_shift *= part;
  // Where a stiff contact has the gap d and a linear step changes it by −r d, its force is to grow by 1 + r: so it does
  // at d / (1 + r).
  const double most = (1.0 + kSpare) * kLargestCorrection * touching_m;
  // All are found before any is made, and a vertex takes the mean of those that it is given: the order of the pairs
  // tells nothing.
  const auto correct = [&] {
    std::map<int, Given> given;
    for (const ContactPair& pair : found) {
      const Approach a = approach(pair);
      const double gap = std::min(a.gap_m, touching_m), after = a.gap_m + a.change_m;
      const double wanted = std::max(kKeptGap * gap, gap * gap / std::max(gap, 2.0 * gap - after));
      if (!(a.give > 0.0) || wanted <= after || wanted - after > most) continue;
      for (int k = 0; k < 4; ++k) {
        const double weight = std::abs(a.feature.weights[k]);
        if (newton_->free().free_of_vertex[pair.vertices[k]] < 0 || weight == 0.0) continue;
        Given& of_vertex = given[pair.vertices[k]];
        of_vertex.sum += weight * (wanted - after) * a.feature.weights[k] / a.give * a.normal;
        of_vertex.weight += weight;
      }
    }
    for (const auto& [v, correction] : given) direction.p.row(v) += (correction.sum / correction.weight).transpose();
    return !given.empty();
  };
  bool corrected = false;
  found = limiting(found);
  for (int round = 0; round < kRounds && !found.empty() && correct(); ++round) {
    corrected = true;
    found = limiting(pairs);
  }
  run.part_of_motion *= part;
  run.bent = part;
  if (!corrected) return step_limit(pairs, step, direction.p, kMovingSlack);
  std::vector<ContactPair> bent = pairs_along(step.x, direction.p);
  const double limit = step_limit(bent, step, direction.p, kMovingSlack);
  if (part * limit < kPoorMove) {
    const double without = step_limit(pairs, step, straight.p, kMovingSlack);
    if (part * limit < without) {
      log_debug("  without corrections");
      direction = straight;
      run.part_of_motion /= part;
      run.bent = 1.0;
      return without;
    }
  }
  pairs = std::move(bent);
  return limit;
}

void TimeStepper::move_object(Step& step, Minimisation& run, const NewtonDirection& direction, double alpha) {
  ++step.report.moving_iterations;
  step.x += alpha * direction.p;
  step.object_shift += alpha * direction.object_shift;
  run.value.reset();
  const double moved = alpha * run.part_of_motion;
  step.gel_way_left *= 1.0 - moved;
  if (moved == 1.0) {
    step.arrived = true;
    if (step.goal.gel_motion.size() > 0) arrive_at_mounts(step);
    place_held_objects(step, step.x);
    return;
  }
  const double made = alpha * run.bent;
  run.relax_next = made < kShortMove;
  run.part_of_motion = std::clamp((made == 1.0 ? kGrowth : 1.0) * moved / (1.0 - moved), kSmallestPart, 1.0);
  run.bent = 1.0;
}

}  // namespace tacipc
