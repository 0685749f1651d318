#include "stages/gel/press/solve/time_step.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/mesh/spatial_order.h"
#include "stages/gel/press/solve/augmented_lagrangian.h"
#include "stages/gel/press/solve/free_bodies.h"
#include "stages/gel/press/solve/head_start.h"
#include "stages/gel/press/solve/held_objects.h"
#include "stages/gel/press/solve/step_terms.h"

namespace tacipc {
namespace {

// If a gap falls below kSmallGap × d̂, the barrier is stiffened so that the same force would leave kWantedGap × d̂ (κ
// b′ ~ κ/d there): at most by kMostStiffeningAtOnce at a time and by kMostStiffening in all.
constexpr double kSmallGap = 0.01, kWantedGap = 0.05, kMostStiffeningAtOnce = 10.0, kMostStiffening = 1e4;

FreeVertices free_vertices(const ContactMesh& mesh, const std::vector<int>& glued, bool augmented_lagrangian,
                           const std::vector<AffineBody>& bodies, const std::vector<int>& free_bodies) {
  std::vector<bool> fixed(static_cast<std::size_t>(mesh.num_rows()), false);
  // Neighbours in space get similar numbers, because the solver sweeps over matrix and vectors from end to end.
  std::vector<int> order = spatial_order(mesh.rest_positions.topRows(mesh.num_gel_vertices));
  // Control points come last: they are coupled to everything that touches their body.
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

TimeStepper::TimeStepper(const ContactMesh& mesh, GelModel gel, const StepSettings& settings,
                         std::vector<AffineBody> bodies)
    : model_{mesh, std::move(gel), settings, std::move(bodies)},
      detector_(model_, times_),
      friction_(model_, detector_),
      minimiser_(model_, detector_, friction_, times_),
      force_report_(model_, detector_) {}

NewtonStepper& TimeStepper::stepper(const std::vector<int>& free_bodies) {
  auto& found = steppers_[free_bodies];
  if (!found)
    found = std::make_unique<NewtonStepper>(
        free_vertices(model_.mesh, model_.gel.glued, model_.settings.augmented_lagrangian, model_.bodies, free_bodies),
        model_.mesh.num_gel_vertices, model_.gel.elasticity, model_.settings.linear_solver);
  return *found;
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

bool TimeStepper::stiffen_barrier(State& state, const Positions& x) {
  if (!model_.settings.adaptive_barrier || state.barrier_factor >= kMostStiffening) return false;
  const double gap = detector_.smallest_relative_gap(x);
  if (gap >= kSmallGap) return false;
  state.barrier_factor =
      std::min(kMostStiffening, std::min(kMostStiffeningAtOnce, kWantedGap / gap) * state.barrier_factor);
  log_debug("  smallest gap {:.2g} of d̂: barrier {:.3g} times as stiff from here on", gap, state.barrier_factor);
  return true;
}

StepReport TimeStepper::advance(State& state, const StepGoal& goal, const IterationObserver& observe) {
  while (true) {
    Step step = start_step(state, goal, observe);
    try {
      const auto minimise = [&] { minimise_constrained(step, [&] { minimiser_.minimise(step); }); };
      minimise();
      friction_.settle(step, minimise);
    } catch (const SolverError& error) {
      // A nearly closed gap is too stiff a spring compared with all others; with a stiffer barrier it stays wider.
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

Step TimeStepper::start_step(const State& state, const StepGoal& goal, const IterationObserver& observe) {
  std::vector<int> free_bodies;
  for (int body = 0; goal.free_object && body < static_cast<int>(model_.bodies.size()); ++body) {
    if (!std::binary_search(goal.held_bodies.begin(), goal.held_bodies.end(), body)) free_bodies.push_back(body);
  }
  NewtonStepper& newton = stepper(free_bodies);
  newton.reset();
  std::vector<bool> held(model_.mesh.objects.size(), true);
  for (const int body : free_bodies) held[static_cast<std::size_t>(body)] = false;
  detector_.start_step(std::move(held), goal.world_from_gel);
  Step step{
      .goal = goal, .observe = observe, .newton = newton, .start = state.x, .x = state.x, .blend = model_.full_blend()};
  step.report.time_steps = 1;
  for (const int body : free_bodies) step.bodies.push_back({.body = body});
  step.arrived = goal.gel_motion.size() == 0 && objects_arrived(model_.mesh, step);
  step.weights = {.h_s = goal.h_s,
                  .barrier_stiffness_j_m4 = state.barrier_factor * model_.settings.barrier_stiffness_j_m4,
                  .friction_coefficient = model_.settings.friction ? model_.settings.laws.largest_friction() : 0.0,
                  .mass_damping_per_s = model_.settings.mass_damping_per_s,
                  .stiffness_damping_s = model_.settings.stiffness_damping_s};
  if (!goal.hand_motion.topLeftCorner<3, 3>().isIdentity(0.0))
    step.turned_start = state.x + way_of(goal.hand_motion, state.x);
  add_terms(model_, state, step);
  if (model_.settings.augmented_lagrangian) add_constraint(model_, step);
  if (goal.free_object) add_free_bodies(model_, state, step);
  if (goal.free_object || goal.gel_motion.size() > 0) start_ahead(model_, detector_, state, step);
  friction_.start(step);
  return step;
}

void TimeStepper::finish_step(Step& step, State& state) {
  const Eigen::Index n = model_.mesh.num_gel_vertices;
  const double h = step.goal.h_s;
  forces_ = force_report_.at_end_of(step);
  if (!model_.bodies.empty()) finish_bodies(model_, forces_.between, step, state);
  if (const auto& gel = model_.gel.viscoelasticity)
    gel->advance(state.viscous_pa, gel->stress(step.x) - step.start_stress_pa, h);
  step.report.object_shift_m = step.object_shift;
  if (model_.settings.quasi_static) {
    state.velocity_m_s.setZero();
  } else {
    state.velocity_m_s = (step.x.topRows(n) - state.x.topRows(n)) / h;
  }
  state.object_velocity_m_s.setZero();
  for (const int axis : step.goal.free_axes) {
    if (step.goal.mount_stiffness_n_m[axis] == 0.0) state.object_velocity_m_s[axis] = step.object_shift[axis] / h;
  }
  state.x = std::move(step.x);
  if (!model_.settings.augmented_lagrangian) place_held_objects(model_.mesh, step, state.x);
}

}  // namespace tacipc
