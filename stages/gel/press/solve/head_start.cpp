#include "stages/gel/press/solve/head_start.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "stages/gel/press/solve/held_objects.h"

namespace tacipc {
namespace {

// Largest relative displacement of gels and objects for which pairs are searched at once: × d̂, or × the median edge of
// the front.
constexpr double kLongestWay = 20.0, kLongestWayOfEdge = 4.0;

/// Displacement of a body at these points with the moving gels that it touches: the mean of their rigid motions.
/// Nothing if it touches none.
std::optional<Positions> way_with_gels(const SolverModel& model, CollisionDetector& detector, const Step& step,
                                       const ObjectPart& object, const Positions& points) {
  const StepGoal& goal = step.goal;
  std::vector<bool> touched(static_cast<std::size_t>(model.mesh.num_gels()), false);
  for (const ContactPair& pair : detector.pairs_at(step.start)) {
    const int first = pair.vertices[0], second = pair.vertices[3];
    if (!object.has(first) && !object.has(second)) continue;
    const int other = object.has(first) ? second : first;
    if (other >= model.mesh.num_gel_vertices) continue;
    const auto gel = static_cast<std::size_t>(model.mesh.body_of(other));
    if (touched[gel] || (goal.gel_motion.row(other).array() == 0.0).all()) continue;
    const double reach_m = model.settings.laws.reach_m(model.mesh, pair);
    touched[gel] = closest_feature(pair, gather(step.start, pair)).squared_distance < reach_m * reach_m;
  }
  Positions sum = Positions::Zero(points.rows(), 3);
  int count = 0;
  for (std::size_t gel = 0; gel < touched.size(); ++gel) {
    if (!touched[gel]) continue;
    sum += way_of(goal.mount_motion.empty() ? goal.hand_motion : goal.mount_motion[gel], points);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return Positions(sum / count);
}

}  // namespace

double relative_way(const ContactMesh& mesh, const Positions& p) {
  const Eigen::RowVector3d of_object =
      mesh.objects.empty() ? Eigen::RowVector3d::Zero() : Eigen::RowVector3d(mesh.object_rows(p).colwise().mean());
  return std::sqrt((p.topRows(mesh.num_vertices()).rowwise() - of_object).rowwise().squaredNorm().maxCoeff());
}

double longest_way(const StepSettings& settings) {
  return std::max(kLongestWay * settings.laws.reach_m(), kLongestWayOfEdge * settings.front_edge_m);
}

void start_ahead(const SolverModel& model, CollisionDetector& detector, const State& state, Step& step) {
  const StepGoal& goal = step.goal;
  Positions p = Positions::Zero(state.x.rows(), 3);
  const bool mounts = goal.gel_motion.size() > 0;
  for (const Step::Body& free : step.bodies) {
    const auto i = static_cast<std::size_t>(free.body);
    const ControlPoints before = state.x.middleRows<4>(model.mesh.control_row(free.body));
    auto points = p.middleRows<4>(model.mesh.control_row(free.body));
    if (const auto way = mounts ? way_with_gels(model, detector, step, model.mesh.objects[i], before) : std::nullopt) {
      // With free flight, a held object and its fingers would slide past each other by far more than their gap.
      points = *way;
    } else {
      // Without its weight, which contact mostly supports.
      points = predicted(model.bodies[i], before, state.object_motion[i], Vector3::Zero(), goal.h_s) - before;
    }
  }
  for (const CarriedBody& body : step.newton.free().carried) body.carry(p);
  if (mounts) p.topRows(model.mesh.num_gel_vertices) = goal.gel_motion;
  // The displacement is made in pieces, because a search for pairs along all of it would find too many.
  const double pieces = std::ceil(relative_way(model.mesh, p) / longest_way(model.settings));
  const Positions piece = p / std::max(1.0, pieces);
  double part = 0.0;
  for (double made = 1.0; part < 1.0 && made == 1.0;) {
    made = detector.step_limit(detector.pairs_along(step.x, piece), step.x, piece, kMovingSlack);
    step.x += made * piece;
    part = std::min(1.0, part + made / std::max(1.0, pieces));
    if (made == 1.0 && part > 1.0 - 0.5 / std::max(1.0, pieces)) part = 1.0;
  }
  if (!mounts) return;
  step.gel_way_left = 1.0 - part;
  if (part < 1.0) return;
  place_glued_vertices(model.gel, goal, step.x);
  step.arrived = objects_arrived(model.mesh, step);
}

}  // namespace tacipc
