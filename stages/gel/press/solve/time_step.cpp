#include "stages/gel/press/solve/time_step.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/mesh/spatial_order.h"
#include "stages/gel/press/contact/near_pairs.h"
#include "stages/gel/press/energy/axis_springs.h"
#include "stages/gel/press/energy/linear_load.h"
#include "stages/gel/press/energy/stiffness_damping.h"
#include "stages/gel/press/solve/local_patch.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {
namespace {

// A barrier that lets a gap become smaller than the first, × d̂, is made stiffer by as much as should leave the second
// under the same force (κ b′ ~ κ/d there), at most by the third factor at once and by the last in all.
constexpr double kSmallGap = 0.01, kWantedGap = 0.05, kMostStiffeningAtOnce = 10.0, kMostStiffening = 1e4;

// Along a longer way of gels and object past each other pairs are not searched: × d̂, or × the median edge of the front.
constexpr double kLongestWay = 20.0, kLongestWayOfEdge = 4.0;

FreeVertices free_vertices(const ContactMesh& mesh, const std::vector<int>& glued, bool augmented_lagrangian,
                           const std::vector<AffineBody>& bodies, const std::vector<int>& free_bodies) {
  std::vector<bool> fixed(static_cast<std::size_t>(mesh.num_rows()), false);
  // Neighbours in space get neighbouring numbers: the solver sweeps over matrix and vectors from end to end.
  std::vector<int> order = spatial_order(mesh.rest_positions.topRows(mesh.num_gel_vertices));
  // Points of bodies come last: they are coupled to all that touch these.
  for (int v = mesh.num_gel_vertices; v < mesh.num_rows(); ++v) order.push_back(v);
  if (augmented_lagrangian) return {order, fixed};
  for (int v = mesh.num_gel_vertices; v < mesh.num_rows(); ++v) fixed[v] = true;
  for (const int body : free_bodies) {
    for (int k = 0; k < 4; ++k) fixed[mesh.control_row(body) + k] = false;
  }
  for (const int v : glued) fixed[v] = true;
  FreeVertices free(order, fixed);
  free.num_control_points = mesh.num_control_points;
  for (std::size_t g = 0; g < mesh.gels.size(); ++g) {
    free.gel_of_vertex.insert(free.gel_of_vertex.end(), mesh.gels[g].mesh->num_gel_vertices, static_cast<int>(g));
    free.gel_without_mount.push_back(mesh.gels[g].anchor < 0);
  }
  for (const int body : free_bodies) {
    const auto i = static_cast<std::size_t>(body);
    free.carried.push_back({mesh.objects[i].first_vertex, bodies[i].weights, mesh.control_row(body)});
  }
  return free;
}

}  // namespace

void StepReport::add_earlier(const StepReport& before) {
  time_steps += before.time_steps;
  newton_iterations += before.newton_iterations;
  moving_iterations += before.moving_iterations;
  patches += before.patches;
  patch_iterations += before.patch_iterations;
  lag_iterations += before.lag_iterations;
  exact_hessian_waits += before.exact_hessian_waits;
  approximated_share = std::max(approximated_share, before.approximated_share);
}

TimeStepper::TimeStepper(const ContactMesh& mesh, GelModel gel, const StepSettings& settings,
                         std::vector<AffineBody> bodies)
    : mesh_(mesh),
      gel_(std::move(gel)),
      tets_of_(gel_.tets, mesh.num_gel_vertices),
      settings_(settings),
      search_(mesh),
      bodies_(std::move(bodies)) {
  std::vector<bool> held(static_cast<std::size_t>(mesh.num_vertices()), false);
  for (const int v : gel_.glued) held[v] = true;
  elasticity_at_mount_ = restricted(gel_.elasticity, held);
}

NewtonStepper& TimeStepper::stepper(const std::vector<int>& free_bodies) {
  auto& found = steppers_[free_bodies];
  if (!found)
    found = std::make_unique<NewtonStepper>(
        free_vertices(mesh_, gel_.glued, settings_.augmented_lagrangian, bodies_, free_bodies), mesh_.num_gel_vertices,
        gel_.elasticity, settings_.linear_solver);
  return *found;
}

IncrementalPotential TimeStepper::potential(const Step& step, std::shared_ptr<const ContactBarrier> barrier) const {
  StepTerms terms = step.terms;
  terms.friction = step.friction;
  terms.barrier = std::move(barrier);
  return make_incremental_potential(terms, step.weights);
}

std::shared_ptr<const ContactBarrier> TimeStepper::barrier(std::vector<ContactPair> pairs) const {
  return std::make_shared<ContactBarrier>(
      mesh_, weighted(std::move(pairs), mesh_, settings_.laws, settings_.pair_counting), settings_.laws);
}

std::vector<ContactPair> TimeStepper::pairs_at(const Positions& x) {
  if (last_search_.x.rows() != x.rows() || (last_search_.x.array() != x.array()).any())
    last_search_ = {x, pairs_along(x, Positions::Zero(x.rows(), 3))};
  return last_search_.pairs;
}

std::vector<ContactPair> TimeStepper::pairs_along(const Positions& x, const Positions& p) {
  const Stopwatch watch(times_.search_s);
  return search_.pairs(x, p, settings_.laws.reach_m());
}

SolverTimes TimeStepper::times() const {
  SolverTimes all = times_;
  for (const auto& [free_bodies, stepper] : steppers_) {
    const SolverTimes newton = stepper->times();
    all.elastic_s += newton.elastic_s;
    all.contact_s += newton.contact_s;
    all.linear_s += newton.linear_s;
    all.solves += newton.solves;
    all.products += newton.products;
    all.factorised += newton.factorised;
  }
  return all;
}

int TimeStepper::num_analyses() const {
  int sum = 0;
  for (const auto& [free_bodies, stepper] : steppers_) sum += stepper->solver().num_analyses();
  return sum;
}

bool TimeStepper::stiffen_barrier(State& state, const Positions& x) {
  if (!settings_.adaptive_barrier || state.barrier_factor >= kMostStiffening) return false;
  const double gap = smallest_relative_gap(x);
  if (gap >= kSmallGap) return false;
  state.barrier_factor =
      std::min(kMostStiffening, std::min(kMostStiffeningAtOnce, kWantedGap / gap) * state.barrier_factor);
  log_debug("  smallest gap {:.2g} of d_hat: barrier {:.3g} times as stiff from here on", gap, state.barrier_factor);
  return true;
}

StepReport TimeStepper::advance(State& state, const StepGoal& goal, const IterationObserver& observe) {
  while (true) {
    Step step = start_step(state, goal, observe);
    try {
      minimise_constrained(step);
      settle_friction(step);
    } catch (const SolverError& error) {
      // A gap that is all but closed is too stiff a spring beside all others; with a stiffer barrier it stays wider.
      if (!stiffen_barrier(state, step.x)) throw;
      log_info("{}; again with {:.3g} times the barrier", error.what(), state.barrier_factor);
      continue;
    }
    finish_step(step, state);
    step.report.barrier_factor = state.barrier_factor;
    stiffen_barrier(state, state.x);
    return step.report;
  }
}

TimeStepper::Step TimeStepper::start_step(const State& state, const StepGoal& goal, const IterationObserver& observe) {
  std::vector<int> free_bodies;
  for (int body = 0; goal.free_object && body < static_cast<int>(bodies_.size()); ++body) {
    if (!std::binary_search(goal.held_bodies.begin(), goal.held_bodies.end(), body)) free_bodies.push_back(body);
  }
  newton_ = &stepper(free_bodies);
  newton_->reset();
  std::vector<bool> held(mesh_.objects.size(), true);
  for (const int body : free_bodies) held[static_cast<std::size_t>(body)] = false;
  search_.hold(std::move(held));
  search_.forget();
  if (!goal.world_from_gel.empty()) search_.turn_gels(goal.world_from_gel);
  last_search_ = {};
  Step step{.goal = goal, .observe = observe, .start = state.x, .x = state.x, .blend = full_blend()};
  step.report.time_steps = 1;
  for (const int body : free_bodies) step.bodies.push_back({.body = body});
  step.arrived = goal.gel_motion.size() == 0 && objects_arrived(step);
  step.weights = {.h_s = goal.h_s,
                  .barrier_stiffness_j_m4 = state.barrier_factor * settings_.barrier_stiffness_j_m4,
                  .friction_coefficient = settings_.friction ? settings_.laws.largest_friction() : 0.0,
                  .mass_damping_per_s = settings_.mass_damping_per_s,
                  .stiffness_damping_s = settings_.stiffness_damping_s};
  if (!goal.hand_motion.topLeftCorner<3, 3>().isIdentity(0.0))
    step.turned_start = state.x + way_of(goal.hand_motion, state.x);
  add_gel_terms(step, state);
  if (gel_.viscoelasticity) add_relaxation(step, state);
  if (!goal.free_axes.empty()) add_object_pull(step, state);
  if (settings_.augmented_lagrangian) add_constraint(step);
  if (goal.free_object) add_bodies(step, state);
  if (goal.free_object || goal.gel_motion.size() > 0) start_ahead(step, state);
  start_friction(step);
  return step;
}

Blend TimeStepper::full_blend() const {
  // Where objects touch nothing but gels, vertices of these are enough.
  const int vertices = mesh_.objects.size() > 1 ? mesh_.num_vertices() : mesh_.num_gel_vertices;
  return Blend(vertices, settings_.newton.adaptive_contact_hessian);
}

void TimeStepper::add_gel_terms(Step& step, const State& state) const {
  const Eigen::Index n = mesh_.num_gel_vertices;
  const double h = step.goal.h_s;
  const Positions start = state.x.topRows(n);
  StepTerms& terms = step.terms;
  terms.elasticity = gel_.elasticity;
  if (!settings_.quasi_static) {
    const Eigen::RowVector3d fall = h * h * settings_.gravity_m_s2.transpose();
    terms.inertia = std::make_shared<Inertia>(gel_.mass_kg, (start + h * state.velocity_m_s).rowwise() + fall);
  } else if (settings_.gravity_m_s2 != Vector3::Zero()) {
    std::vector<int> all(static_cast<std::size_t>(n));
    std::iota(all.begin(), all.end(), 0);
    terms.gravity = std::make_shared<LinearLoad>(std::move(all), gel_.mass_kg * settings_.gravity_m_s2.transpose());
  }
  if (settings_.stiffness_damping_s > 0.0)
    terms.stiffness_damping = std::make_shared<StiffnessDamping>(gel_.elasticity, start_beside_mounts(step));
  if (settings_.mass_damping_per_s > 0.0) terms.mass_damping = std::make_shared<Inertia>(gel_.mass_kg, start);
}

Positions TimeStepper::start_beside_mounts(const Step& step) const {
  Positions start = step.compared_start().topRows(mesh_.num_gel_vertices);
  for (std::size_t g = 0; g < step.goal.mount_motion.size(); ++g) {
    auto rows = start.middleRows(mesh_.gels[g].first_vertex, mesh_.gels[g].mesh->num_gel_vertices);
    rows += way_of(step.goal.mount_motion[g], Positions(rows));
  }
  return start;
}

void TimeStepper::add_relaxation(Step& step, const State& state) const {
  const Viscoelasticity& gel = *gel_.viscoelasticity;
  step.start_stress_pa = gel.stress(state.x);
  step.terms.viscous_memory = gel.memory(state.viscous_pa, step.start_stress_pa, step.goal.h_s);
  step.weights.elastic_factors = gel.elastic_factors(step.goal.h_s);
}

void TimeStepper::add_object_pull(Step& step, const State& state) const {
  const StepGoal& goal = step.goal;
  const int n = mesh_.num_gel_vertices;
  const double h = goal.h_s;
  Vector3 stiffness = Vector3::Constant(goal.object_mass_kg),
          target = goal.object_target.row(0) - goal.mount_shift_m.transpose();
  for (int axis = 0; axis < 3; ++axis) {
    if (const double mount = goal.mount_stiffness_n_m[axis]; mount > 0.0) {
      stiffness[axis] = h * h * mount;
    } else if (goal.object_mass_kg > 0.0) {
      target[axis] = state.x(n, axis) + h * state.object_velocity_m_s[axis] + h * h * settings_.gravity_m_s2[axis] +
                     h * h / goal.object_mass_kg * goal.load_n[axis];
    }
  }
  step.terms.object_pull = std::make_shared<AxisSprings>(n, stiffness, target);
}

double TimeStepper::relative_way(const Positions& p) const {
  const Eigen::RowVector3d of_object =
      mesh_.objects.empty() ? Eigen::RowVector3d::Zero() : Eigen::RowVector3d(mesh_.object_rows(p).colwise().mean());
  return std::sqrt((p.topRows(mesh_.num_vertices()).rowwise() - of_object).rowwise().squaredNorm().maxCoeff());
}

double TimeStepper::longest_way() const {
  return std::max(kLongestWay * settings_.laws.reach_m(), kLongestWayOfEdge * settings_.front_edge_m);
}

void TimeStepper::arrive_at_mounts(Step& step) const {
  for (std::size_t i = 0; i < gel_.glued.size(); ++i)
    step.x.row(gel_.glued[i]) = step.goal.glued_target.row(static_cast<Eigen::Index>(i));
}

void TimeStepper::finish_step(Step& step, State& state) {
  const Eigen::Index n = mesh_.num_gel_vertices;
  const double h = step.goal.h_s;
  record_forces(step);
  if (!bodies_.empty()) finish_bodies(step, state);
  if (const auto& gel = gel_.viscoelasticity)
    gel->advance(state.viscous_pa, gel->stress(step.x) - step.start_stress_pa, h);
  step.report.object_shift_m = step.object_shift;
  if (settings_.quasi_static) {
    state.velocity_m_s.setZero();
  } else {
    state.velocity_m_s = (step.x.topRows(n) - state.x.topRows(n)) / h;
  }
  state.object_velocity_m_s.setZero();
  for (const int axis : step.goal.free_axes) {
    if (step.goal.mount_stiffness_n_m[axis] == 0.0) state.object_velocity_m_s[axis] = step.object_shift[axis] / h;
  }
  state.x = std::move(step.x);
  if (!settings_.augmented_lagrangian) place_held_objects(step, state.x);
}

double TimeStepper::smallest_gap(const Positions& x, double none) {
  // Where anything touches, the pairs within d̂ suffice: a wider search finds many times as many.
  const auto within_one = [&](const ContactPair& pair) {
    return mesh_.body_of(pair.vertices[0]) == mesh_.body_of(pair.vertices[3]);
  };
  std::vector<ContactPair> pairs = pairs_at(x);
  std::erase_if(pairs, within_one);
  const double near = smallest_distance(pairs, x, none);
  if (near < std::min(settings_.laws.reach_m(), none)) return near;
  return smallest_distance(search_.pairs_of_bodies(x, Positions::Zero(x.rows(), 3), none), x, none);
}

double TimeStepper::smallest_relative_gap(const Positions& x) {
  const ContactLaws& laws = settings_.laws;
  const std::vector<ContactPair> pairs = pairs_at(x);
  double smallest = 1.0;
  for (const int i : near_pairs(pairs, x, laws.reach_m() * laws.reach_m())) {
    const ContactPair& pair = pairs[static_cast<std::size_t>(i)];
    if (mesh_.body_of(pair.vertices[0]) == mesh_.body_of(pair.vertices[3])) continue;
    const double own = laws.all()[laws.index(mesh_, pair)].d_hat_m;
    smallest = std::min(smallest, std::sqrt(closest_feature(pair, gather(x, pair)).squared_distance) / own);
  }
  return smallest;
}

}  // namespace tacipc
