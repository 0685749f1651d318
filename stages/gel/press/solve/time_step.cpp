#include "stages/gel/press/solve/time_step.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/mesh/spatial_order.h"
#include "stages/gel/press/contact/near_pairs.h"
#include "stages/gel/press/energy/linear_load.h"
#include "stages/gel/press/energy/orthogonality.h"
#include "stages/gel/press/energy/stiffness_damping.h"
#include "stages/gel/press/solve/local_patch.h"
#include "stages/gel/press/solve/step_limit.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {
namespace {

// A barrier that lets a gap become smaller than the first, × d̂, is made stiffer by as much as should leave the second
// under the same force (κ b′ ~ κ/d there), at most by the third factor at once and by the last in all.
constexpr double kSmallGap = 0.01, kWantedGap = 0.05, kMostStiffeningAtOnce = 10.0, kMostStiffening = 1e4;

// Along a longer way of gels and object past each other pairs are not searched: × d̂, or × the median edge of the front.
constexpr double kLongestWay = 20.0, kLongestWayOfEdge = 4.0;

/// How far a rigid motion takes each point.
Positions way_of(const Matrix4& motion, const Positions& from) {
  const Matrix3 turn = motion.topLeftCorner<3, 3>() - Matrix3::Identity();
  return (from * turn.transpose()).rowwise() + motion.topRightCorner<3, 1>().transpose();
}

FreeVertices free_vertices(const ContactMesh& mesh, const std::vector<int>& glued, bool augmented_lagrangian,
                           const AffineBody* free_body) {
  std::vector<bool> fixed(static_cast<std::size_t>(mesh.num_rows()), false);
  // Neighbours in space get neighbouring numbers: the solver sweeps over matrix and vectors from end to end.
  std::vector<int> order = spatial_order(mesh.rest_positions.topRows(mesh.num_gel_vertices));
  // A body's points come last: they are coupled to all that touch it.
  for (int v = mesh.num_gel_vertices; v < mesh.num_rows(); ++v) order.push_back(v);
  if (augmented_lagrangian) return {order, fixed};
  const int last = free_body ? mesh.num_vertices() : mesh.num_rows();
  for (int v = mesh.num_gel_vertices; v < last; ++v) fixed[v] = true;
  for (const int v : glued) fixed[v] = true;
  FreeVertices free(order, fixed);
  free.num_control_points = mesh.num_control_points;
  for (std::size_t g = 0; g < mesh.gels.size(); ++g)
    free.gel_of_vertex.insert(free.gel_of_vertex.end(), mesh.gels[g].mesh->num_gel_vertices, static_cast<int>(g));
  if (free_body) free.carried = {{mesh.num_gel_vertices, free_body->weights, mesh.num_vertices()}};
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
                         std::optional<AffineBody> body)
    : mesh_(mesh), gel_(std::move(gel)), settings_(settings), search_(mesh), body_(std::move(body)) {
  const auto stepper = [&](const AffineBody* free_body) {
    return std::make_unique<NewtonStepper>(free_vertices(mesh, gel_.glued, settings.augmented_lagrangian, free_body),
                                           mesh.num_gel_vertices, gel_.elasticity, settings.linear_solver);
  };
  held_object_ = stepper(nullptr);
  if (body_) free_object_ = stepper(&*body_);
  newton_ = held_object_.get();
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
  SolverTimes all = times_;
  for (const NewtonStepper* stepper : {held_object_.get(), free_object_.get()}) {
    if (!stepper) continue;
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
  return held_object_->solver().num_analyses() + (free_object_ ? free_object_->solver().num_analyses() : 0);
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
  newton_ = goal.free_object ? free_object_.get() : held_object_.get();
  newton_->reset();
  search_.forget();
  if (!goal.world_from_gel.empty()) search_.turn_gels(goal.world_from_gel);
  last_search_ = {};
  Step step{.goal = goal,
            .observe = observe,
            .start = state.x,
            .x = state.x,
            .blend = Blend(mesh_.num_gel_vertices, settings_.newton.adaptive_contact_hessian)};
  step.report.time_steps = 1;
  step.arrived = goal.gel_motion.size() == 0 && object_arrived(step);
  step.weights = {.h_s = goal.h_s,
                  .barrier_stiffness_j_m4 = state.barrier_factor * settings_.barrier_stiffness_j_m4,
                  .friction_coefficient = settings_.friction ? settings_.friction->coefficient : 0.0,
                  .mass_damping_per_s = settings_.mass_damping_per_s,
                  .stiffness_damping_s = settings_.stiffness_damping_s};
  if (!goal.hand_motion.topLeftCorner<3, 3>().isIdentity(0.0))
    step.turned_start = state.x + way_of(goal.hand_motion, state.x);
  add_gel_terms(step, state);
  if (gel_.viscoelasticity) add_relaxation(step, state);
  if (!goal.free_axes.empty()) add_object_inertia(step, state);
  if (settings_.augmented_lagrangian) add_constraint(step);
  if (goal.free_object) add_body(step, state);
  if (goal.free_object || goal.gel_motion.size() > 0) start_ahead(step, state);
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
    terms.stiffness_damping =
        std::make_shared<StiffnessDamping>(gel_.elasticity, Positions(step.compared_start().topRows(n)));
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

void TimeStepper::add_body(Step& step, const State& state) {
  const StepGoal& goal = step.goal;
  const ControlPoints before = mesh_.control_rows(state.x);
  step.acceleration_m_s2 = settings_.gravity_m_s2 + goal.load_n / body_->mass_kg;
  step.weight_n = body_->mass_kg * std::max(settings_.gravity_m_s2.norm(), goal.load_n.norm() / body_->mass_kg);
  step.predicted = predicted(*body_, before, state.object_motion, step.acceleration_m_s2, goal.h_s);
  const int first = mesh_.num_vertices();
  step.terms.body_inertia =
      std::make_shared<Inertia>(Eigen::VectorXd::Constant(4, 0.25 * body_->mass_kg), Positions(step.predicted), first);
  step.terms.body_orthogonality = std::make_shared<Orthogonality>(first, *body_, orthogonality_pa(*body_));
}

double TimeStepper::relative_way(const Positions& p) const {
  const Eigen::RowVector3d of_object = mesh_.object_rows(p).colwise().mean();
  return std::sqrt((p.topRows(mesh_.num_vertices()).rowwise() - of_object).rowwise().squaredNorm().maxCoeff());
}

double TimeStepper::longest_way() const {
  return std::max(kLongestWay * settings_.d_hat_m, kLongestWayOfEdge * settings_.front_edge_m);
}

bool TimeStepper::object_arrived(const Step& step) const {
  return step.goal.free_object || (mesh_.object_rows(step.x) - step.goal.object_target).cwiseAbs().maxCoeff() == 0.0;
}

void TimeStepper::start_ahead(Step& step, const State& state) {
  const StepGoal& goal = step.goal;
  Positions p = Positions::Zero(state.x.rows(), 3);
  const bool mounts = goal.gel_motion.size() > 0;
  if (goal.free_object) {
    const ControlPoints before = mesh_.control_rows(state.x);
    if (mounts && smallest_gap(state.x, settings_.d_hat_m) < settings_.d_hat_m) {
      // Gaps are far smaller than what a held object and its fingers would slide past each other otherwise.
      mesh_.control_rows(p) = way_of(goal.hand_motion, before);
    } else {
      // Without its weight, which contact mostly carries.
      mesh_.control_rows(p) = predicted(*body_, before, state.object_motion, Vector3::Zero(), goal.h_s) - before;
    }
    for (const CarriedBody& body : newton_->free().carried) body.carry(p);
  }
  if (mounts) p.topRows(mesh_.num_gel_vertices) = goal.gel_motion;
  // Piece by piece: a search for pairs along a long way would find too many.
  const double pieces = std::ceil(relative_way(p) / longest_way());
  const Positions piece = p / std::max(1.0, pieces);
  double part = 0.0;
  for (double made = 1.0; part < 1.0 && made == 1.0;) {
    made = step_limit(pairs_along(step.x, piece), step, piece, kMovingSlack);
    step.x += made * piece;
    part = std::min(1.0, part + made / std::max(1.0, pieces));
    if (made == 1.0 && part > 1.0 - 0.5 / std::max(1.0, pieces)) part = 1.0;
  }
  if (!mounts) return;
  step.gel_way_left = 1.0 - part;
  if (part < 1.0) return;
  arrive_at_mounts(step);
  step.arrived = object_arrived(step);
}

void TimeStepper::arrive_at_mounts(Step& step) const {
  for (std::size_t i = 0; i < gel_.glued.size(); ++i)
    step.x.row(gel_.glued[i]) = step.goal.glued_target.row(static_cast<Eigen::Index>(i));
}

void TimeStepper::finish_body(Step& step, State& state) const {
  const double h = step.goal.h_s;
  if (!step.goal.free_object) {
    // Whoever moves it gives it the momentum of its rigid motion.
    const ControlPoints before = mesh_.control_rows(state.x);
    const ControlPoints now = step.goal.control_target.rowwise() + step.object_shift.transpose();
    state.object_motion = after_step(*body_, before, now, {}, Vector3::Zero(), h);
    mesh_.control_rows(step.x) = now;
    return;
  }
  for (const CarriedBody& body : newton_->free().carried) body.carry(step.x);
  const ControlPoints now = mesh_.control_rows(step.x);
  state.object_motion = after_step(*body_, step.predicted, now, state.object_motion, step.acceleration_m_s2, h);
  // Contact acts on the body as on the gel, the other way.
  const Eigen::RowVector3d center = now.colwise().mean();
  const Wrench inertia = wrench_of(now, 0.25 * body_->mass_kg / (h * h) * (now - step.predicted));
  Vector3 force = inertia.force_n, torque = inertia.torque_n_m;
  for (Eigen::Index v = 0; v < mesh_.num_gel_vertices; ++v) {
    const Vector3 of_contact = forces_.normal.row(v) + forces_.friction.row(v);
    force += of_contact;
    torque += Vector3(step.x.row(v) - center).cross(of_contact);
  }
  step.report.body_residual_n = force.norm();
  step.report.body_residual_n_m = torque.norm();
  step.report.body_load_n = step.weight_n;
}

void TimeStepper::finish_step(Step& step, State& state) {
  const Eigen::Index n = mesh_.num_gel_vertices;
  const double h = step.goal.h_s;
  record_forces(step);
  if (body_) finish_body(step, state);
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
  if (!settings_.augmented_lagrangian && !step.goal.free_object)
    mesh_.object_rows(state.x) = step.goal.object_target.rowwise() + step.object_shift.transpose();
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
