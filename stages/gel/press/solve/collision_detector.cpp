#include "stages/gel/press/solve/collision_detector.h"

#include <algorithm>
#include <cmath>

#include "stages/gel/press/contact/near_pairs.h"

namespace tacipc {
namespace {

constexpr double kGapFloor = 1e-4;  // × d̂: no step leaves a smaller gap

}  // namespace

CollisionDetector::CollisionDetector(const SolverModel& model, SolverTimes& times)
    : model_(model), times_(times), search_(model.mesh) {}

void CollisionDetector::start_step(std::vector<bool> held, const std::vector<Matrix3>& world_from_gel) {
  search_.hold(std::move(held));
  search_.forget();
  if (!world_from_gel.empty()) search_.turn_gels(world_from_gel);
  last_search_ = {};
}

std::vector<ContactPair> CollisionDetector::pairs_at(const Positions& x) {
  if (last_search_.x.rows() != x.rows() || (last_search_.x.array() != x.array()).any())
    last_search_ = {x, pairs_along(x, Positions::Zero(x.rows(), 3))};
  return last_search_.pairs;
}

std::vector<ContactPair> CollisionDetector::pairs_along(const Positions& x, const Positions& p) {
  const Stopwatch watch(times_.search_s);
  return search_.pairs(x, p, model_.settings.laws.reach_m());
}

GapRule CollisionDetector::gap_rule(double slack) const {
  const double reach_m = model_.settings.laws.reach_m();
  return {slack, kGapFloor * reach_m, reach_m};
}

double CollisionDetector::step_limit(const std::vector<ContactPair>& pairs, const Positions& x, const Positions& p,
                                     double slack) {
  const Stopwatch watch(times_.limits_s);
  return std::min(contact_step_limit(pairs, x, p, gap_rule(slack)), inversion_step_limit(model_.gel.tets, x, p));
}

std::vector<ContactPair> CollisionDetector::limiting_pairs(const std::vector<ContactPair>& pairs, const Positions& x,
                                                           const Positions& p, double slack) {
  const Stopwatch watch(times_.limits_s);
  return tacipc::limiting_pairs(pairs, x, p, gap_rule(slack));
}

bool CollisionDetector::within_one_body(const ContactPair& pair) const {
  return model_.mesh.body_of(pair.vertices[0]) == model_.mesh.body_of(pair.vertices[3]);
}

double CollisionDetector::smallest_gap(const Positions& x, double none) {
  // If anything touches, the pairs within d̂ suffice: a wider search finds many times as many.
  std::vector<ContactPair> pairs = pairs_at(x);
  std::erase_if(pairs, [&](const ContactPair& pair) { return within_one_body(pair); });
  const double near = smallest_distance(pairs, x, none);
  if (near < std::min(model_.settings.laws.reach_m(), none)) return near;
  return smallest_distance(search_.pairs_of_bodies(x, Positions::Zero(x.rows(), 3), none), x, none);
}

double CollisionDetector::smallest_relative_gap(const Positions& x) {
  const ContactLaws& laws = model_.settings.laws;
  const std::vector<ContactPair> pairs = pairs_at(x);
  double smallest = 1.0;
  for (const int i : near_pairs(pairs, x, laws.reach_m() * laws.reach_m())) {
    const ContactPair& pair = pairs[static_cast<std::size_t>(i)];
    if (within_one_body(pair)) continue;
    const double gap_m = std::sqrt(closest_feature(pair, gather(x, pair)).squared_distance);
    smallest = std::min(smallest, gap_m / laws.reach_m(model_.mesh, pair));
  }
  return smallest;
}

}  // namespace tacipc
