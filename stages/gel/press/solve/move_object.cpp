#include "stages/gel/press/solve/move_object.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/log.h"
#include "stages/gel/press/solve/held_objects.h"

namespace tacipc {
namespace {

// Largest correction of most contacts, and of a few of them, × d̂.
constexpr double kCorrection = 0.3, kLargestCorrection = 1.0;
constexpr std::size_t kLargeCorrections = 3;
/// Margin, as a fraction of the largest correction, by which a correction may grow while others are made.
constexpr double kSpare = 0.1;
constexpr int kRounds = 3;
// Smallest fraction of its gap, counted up to d̂, that a corrected contact keeps: slightly more than a move must leave.
constexpr double kKeptGap = 1.03 * kMovingSlack;
// If less than this fraction of a corrected move is possible, it is compared with the uncorrected one.
constexpr double kPoorMove = 0.5;
// After a complete move the next one is kMoveGrowth times as long; after less than kShortMove of one, the gel is
// relaxed first.
constexpr double kMoveGrowth = 2.0, kShortMove = 0.1;
constexpr double kSmallestPart = 1e-3;  // smallest fraction of the object's remaining motion that a move attempts

/// Change of a pair's gap in a move, to first order: the normal is constant.
struct Approach {
  ClosestFeature feature;
  Vector3 normal;
  double gap_m, change_m;
  double give = 0.0;  // Σ weight² over the free gel vertices: their joint contribution to a correction
};

/// Approach of a pair in a move. \param p displacements from x
Approach approach(const ContactPair& pair, const Positions& x, const Positions& p, const FreeVertices& free) {
  Approach a{.feature = closest_feature(pair, gather(x, pair)), .normal = {}, .gap_m = 0.0, .change_m = 0.0};
  a.gap_m = std::sqrt(a.feature.squared_distance);
  a.normal = a.feature.r / a.gap_m;
  for (int k = 0; k < 4; ++k) {
    const int v = pair.vertices[k];
    a.change_m += a.feature.weights[k] * a.normal.dot(p.row(v));
    if (free.free_of_vertex[v] >= 0) a.give += a.feature.weights[k] * a.feature.weights[k];
  }
  return a;
}

/// Fraction of p that corrections allow at the limiting pairs. \param reach_m d̂
double correctable_part(const std::vector<ContactPair>& limiting, const Positions& x, const Positions& p,
                        const FreeVertices& free, double reach_m) {
  double part = 1.0;
  std::vector<double> parts;
  for (const ContactPair& pair : limiting) {
    const Approach a = approach(pair, x, p, free);
    if (!(a.change_m < 0.0)) continue;
    const double kept = kKeptGap * std::min(a.gap_m, reach_m), most = a.give > 0.0 ? reach_m : 0.0;
    part = std::min(part, (a.gap_m + kLargestCorrection * most - kept) / -a.change_m);
    parts.push_back((a.gap_m + kCorrection * most - kept) / -a.change_m);
  }
  if (parts.size() > kLargeCorrections) {
    std::nth_element(parts.begin(), parts.begin() + kLargeCorrections, parts.end());
    part = std::min(part, parts[kLargeCorrections]);
  }
  return part;
}

/// Corrections of one vertex, weighted by its part in their pairs.
struct Given {
  Vector3 sum = Vector3::Zero();
  double weight = 0.0;
};

/// Corrects p at the limiting pairs once. \return whether any vertex is corrected
bool correct(const std::vector<ContactPair>& limiting, const Positions& x, const FreeVertices& free, double reach_m,
             Positions& p) {
  // If a stiff contact has the gap d and a linear step changes it by −r d, its force should grow by 1 + r, which it
  // does at the gap d / (1 + r).
  const double most = (1.0 + kSpare) * kLargestCorrection * reach_m;
  // All corrections are computed before any is applied, and a vertex takes the mean of its corrections, so that the
  // order of the pairs does not matter.
  std::map<int, Given> given;
  for (const ContactPair& pair : limiting) {
    const Approach a = approach(pair, x, p, free);
    const double gap = std::min(a.gap_m, reach_m), after = a.gap_m + a.change_m;
    const double wanted = std::max(kKeptGap * gap, gap * gap / std::max(gap, 2.0 * gap - after));
    if (!(a.give > 0.0) || wanted <= after || wanted - after > most) continue;
    for (int k = 0; k < 4; ++k) {
      const double weight = std::abs(a.feature.weights[k]);
      if (free.free_of_vertex[pair.vertices[k]] < 0 || weight == 0.0) continue;
      Given& of_vertex = given[pair.vertices[k]];
      of_vertex.sum += weight * (wanted - after) * a.feature.weights[k] / a.give * a.normal;
      of_vertex.weight += weight;
    }
  }
  for (const auto& [v, correction] : given) p.row(v) += (correction.sum / correction.weight).transpose();
  return !given.empty();
}

}  // namespace

bool ObjectMover::correct_direction(const Step& step, std::vector<ContactPair> limiting,
                                    const std::vector<ContactPair>& pairs, NewtonDirection& direction) {
  const auto still_limiting = [&](const std::vector<ContactPair>& among) {
    return detector_.limiting_pairs(among, step.x, direction.p, kMovingSlack);
  };
  const FreeVertices& free = step.newton.free();
  const double reach_m = model_.settings.laws.reach_m();
  limiting = still_limiting(limiting);
  bool corrected = false;
  for (int round = 0; round < kRounds && !limiting.empty(); ++round) {
    if (!correct(limiting, step.x, free, reach_m, direction.p)) break;
    corrected = true;
    limiting = still_limiting(pairs);
  }
  return corrected;
}

double ObjectMover::bend_at_contacts(const Step& step, Minimisation& run, NewtonDirection& direction,
                                     std::vector<ContactPair>& pairs) {
  const std::vector<ContactPair> found = detector_.limiting_pairs(pairs, step.x, direction.p, kMovingSlack);
  if (found.empty()) return detector_.step_limit(pairs, step.x, direction.p, kMovingSlack);
  const double part = correctable_part(found, step.x, direction.p, step.newton.free(), model_.settings.laws.reach_m());
  const NewtonDirection straight = direction;
  direction.p *= part;
  direction.object_shift *= part;
  const bool corrected = correct_direction(step, found, pairs, direction);
  run.part_of_motion *= part;
  run.bent = part;
  if (!corrected) return detector_.step_limit(pairs, step.x, direction.p, kMovingSlack);
  std::vector<ContactPair> bent = detector_.pairs_along(step.x, direction.p);
  const double limit = detector_.step_limit(bent, step.x, direction.p, kMovingSlack);
  if (part * limit < kPoorMove) {
    const double without = detector_.step_limit(pairs, step.x, straight.p, kMovingSlack);
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

void ObjectMover::move(Step& step, Minimisation& run, const NewtonDirection& direction, double alpha) const {
  ++step.report.moving_iterations;
  step.x += alpha * direction.p;
  step.object_shift += alpha * direction.object_shift;
  run.value.reset();
  const double moved = alpha * run.part_of_motion;
  step.gel_way_left *= 1.0 - moved;
  if (moved == 1.0) {
    step.arrived = true;
    if (step.goal.gel_motion.size() > 0) place_glued_vertices(model_.gel, step.goal, step.x);
    place_held_objects(model_.mesh, step, step.x);
    return;
  }
  const double made = alpha * run.bent;
  run.relax_next = made < kShortMove;
  run.part_of_motion = std::clamp((made == 1.0 ? kMoveGrowth : 1.0) * moved / (1.0 - moved), kSmallestPart, 1.0);
  run.bent = 1.0;
}

}  // namespace tacipc
