#include "stages/gel/press/solve/time_step.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/mesh/spatial_order.h"
#include "stages/gel/press/contact/near_pairs.h"
#include "stages/gel/press/energy/linear_load.h"
#include "stages/gel/press/energy/stiffness_damping.h"
#include "stages/gel/press/solve/local_patch.h"
#include "stages/gel/press/solve/step_limit.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {
namespace {

// A barrier that lets a gap become smaller than the first, × d̂, is made stiffer by as much as should leave the second
// under the same force (κ b′ ~ κ/d there), at most by the third factor at once and by the last in all.
constexpr double kSmallGap = 0.01, kWantedGap = 0.05, kMostStiffeningAtOnce = 10.0, kMostStiffening = 1e4;

FreeVertices free_vertices(const ContactMesh& mesh, const std::vector<int>& glued, bool augmented_lagrangian) {
  std::vector<bool> fixed(static_cast<std::size_t>(mesh.num_vertices()), false);
  // Neighbours in space get neighbouring numbers: the solver sweeps over matrix and vectors from end to end.
  std::vector<int> order = spatial_order(mesh.rest_positions.topRows(mesh.num_gel_vertices));
  for (int v = mesh.num_gel_vertices; v < mesh.num_vertices(); ++v) order.push_back(v);
  if (augmented_lagrangian) return {order, fixed};
  for (int v = mesh.num_gel_vertices; v < mesh.num_vertices(); ++v) fixed[v] = true;
  for (const int v : glued) fixed[v] = true;
  return {order, fixed};
}

}  // namespace

TimeStepper::TimeStepper(const ContactMesh& mesh, GelModel gel, const StepSettings& settings)
    : mesh_(mesh),
      gel_(std::move(gel)),
      settings_(settings),
      search_(mesh),
      newton_(free_vertices(mesh, gel_.glued, settings.augmented_lagrangian), mesh.num_gel_vertices, gel_.elasticity,
              settings.linear_solver) {
  std::vector<bool> held(static_cast<std::size_t>(mesh.num_vertices()), false);
  for (const int v : gel_.glued) held[v] = true;
  elasticity_at_mount_ = restricted(gel_.elasticity, held);
}

IncrementalPotential TimeStepper::potential(const Step& step, std::shared_ptr<const ContactBarrier> barrier) const {
  StepTerms terms = step.terms;
  terms.friction = step.friction;
  terms.barrier = std::move(barrier);
  return make_incremental_potential(terms, step.weights);
}

std::shared_ptr<const ContactBarrier> TimeStepper::barrier(std::vector<ContactPair> pairs) const {
  return std::make_shared<ContactBarrier>(mesh_, weighted(std::move(pairs), mesh_, settings_.pair_counting),
                                          settings_.d_hat_m);
}

std::vector<ContactPair> TimeStepper::pairs_at(const Positions& x) {
  if (last_search_.x.rows() != x.rows() || (last_search_.x.array() != x.array()).any())
    last_search_ = {x, pairs_along(x, Positions::Zero(x.rows(), 3))};
  return last_search_.pairs;
}

std::vector<ContactPair> TimeStepper::pairs_along(const Positions& x, const Positions& p) {
  const Stopwatch watch(times_.search_s);
  return search_.pairs(x, p, settings_.d_hat_m);
}

SolverTimes TimeStepper::times() const {
  const SolverTimes newton = newton_.times();
  SolverTimes all = times_;
  all.elastic_s = newton.elastic_s;
  all.contact_s = newton.contact_s;
  all.linear_s = newton.linear_s;
  all.solves = newton.solves;
  all.products = newton.products;
  all.factorised = newton.factorised;
  return all;
}

bool TimeStepper::stiffen_barrier(State& state, const Positions& x) {
  if (!settings_.adaptive_barrier || state.barrier_factor >= kMostStiffening) return false;
  const double gap = smallest_gap(x, settings_.d_hat_m) / settings_.d_hat_m;
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
  newton_.reset();
  search_.forget();
  last_search_ = {};
  Step step{.goal = goal,
            .observe = observe,
            .start = state.x,
            .x = state.x,
            .blend = Blend(mesh_.num_gel_vertices, settings_.newton.adaptive_contact_hessian)};
  step.report.time_steps = 1;
  step.arrived = (state.x.bottomRows(mesh_.num_object_vertices) - goal.object_target).cwiseAbs().maxCoeff() == 0.0;
  step.weights = {.h_s = goal.h_s,
                  .barrier_stiffness_j_m4 = state.barrier_factor * settings_.barrier_stiffness_j_m4,
                  .friction_coefficient = settings_.friction ? settings_.friction->coefficient : 0.0,
                  .mass_damping_per_s = settings_.mass_damping_per_s,
                  .stiffness_damping_s = settings_.stiffness_damping_s};
  add_gel_terms(step, state);
  if (gel_.viscoelasticity) add_relaxation(step, state);
  if (!goal.free_axes.empty()) add_object_inertia(step, state);
  if (settings_.augmented_lagrangian) add_constraint(step);
  start_friction(step);
  return step;
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
    terms.stiffness_damping = std::make_shared<StiffnessDamping>(gel_.elasticity, start);
  if (settings_.mass_damping_per_s > 0.0) terms.mass_damping = std::make_shared<Inertia>(gel_.mass_kg, start);
}

void TimeStepper::add_relaxation(Step& step, const State& state) const {
  const Viscoelasticity& gel = *gel_.viscoelasticity;
  step.start_stress_pa = gel.stress(state.x);
  step.terms.viscous_memory = gel.memory(state.viscous_pa, step.start_stress_pa, step.goal.h_s);
  step.weights.elastic_factor = gel.elastic_factor(step.goal.h_s);
}

void TimeStepper::add_object_inertia(Step& step, const State& state) const {
  const StepGoal& goal = step.goal;
  const int n = mesh_.num_gel_vertices;
  const double h = goal.h_s;
  const Eigen::RowVector3d fall = h * h * settings_.gravity_m_s2.transpose();
  const Eigen::RowVector3d x_hat = state.x.row(n) + h * state.object_velocity_m_s.transpose() + fall +
                                   h * h / goal.object_mass_kg * goal.load_n.transpose();
  step.terms.object_inertia =
      std::make_shared<Inertia>(Eigen::VectorXd::Constant(1, goal.object_mass_kg), Positions(x_hat), n);
}

void TimeStepper::finish_step(Step& step, State& state) {
  const Eigen::Index n = mesh_.num_gel_vertices;
  const double h = step.goal.h_s;
  record_forces(step);
  if (const auto& gel = gel_.viscoelasticity)
    gel->advance(state.viscous_pa, gel->stress(step.x) - step.start_stress_pa, h);
  step.report.object_shift_m = step.object_shift;
  if (settings_.quasi_static) {
    state.velocity_m_s.setZero();
  } else {
    state.velocity_m_s = (step.x.topRows(n) - state.x.topRows(n)) / h;
  }
  state.object_velocity_m_s.setZero();
  for (const int axis : step.goal.free_axes) state.object_velocity_m_s[axis] = step.object_shift[axis] / h;
  state.x = std::move(step.x);
  if (!settings_.augmented_lagrangian)
    state.x.bottomRows(mesh_.num_object_vertices) = step.goal.object_target.rowwise() + step.object_shift.transpose();
}

double TimeStepper::smallest_gap(const Positions& x, double none) {
  // Where anything touches, the pairs within d̂ suffice: a wider search finds many times as many.
  std::vector<ContactPair> pairs = pairs_at(x);
  std::erase_if(pairs, [&](const ContactPair& pair) {
    return std::all_of(pair.vertices.begin(), pair.vertices.end(), [&](int v) { return v < mesh_.num_gel_vertices; });
  });
  const double near = smallest_distance(pairs, x, none);
  if (near < std::min(settings_.d_hat_m, none)) return near;
  return smallest_distance(search_.object_pairs(x, Positions::Zero(x.rows(), 3), none), x, none);
}

}  // namespace tacipc
