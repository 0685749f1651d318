#include "stages/press/solve/time_step.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/error.h"
#include "common/log.h"
#include "common/spatial_order.h"
#include "stages/press/contact/near_pairs.h"
#include "stages/press/energy/linear_load.h"
#include "stages/press/energy/stiffness_damping.h"
#include "stages/press/solve/local_patch.h"
#include "stages/press/solve/step_limit.h"
#include "stages/press/solve/step_under_way.h"

namespace tacipc {
namespace {

constexpr double kMovingSlack = 0.3;  // gaps kept while the object moves, where no energy guards the step
constexpr int kMaxWait = 10;          // for the exact Hessian: iterations that meet the tolerances
constexpr double kFar = 10.0, kRoughDirection = 1e-2, kFineDirection = 1e-3;
// A step this many times as long as the last one is none to trust.
constexpr double kTooLong = 4.0;
constexpr int kMaxHalvings = 40;
constexpr double kFarthest = 0.3;  // of the longest step of a vertex
// Augmented Lagrangian: stiffness per vertex over that of a contact pair, when targets count as met, and how often
// multipliers are renewed at most.
constexpr double kConstraintStiffness = 100.0, kConstraintTolerance = 2e-10;
constexpr double kSlowProgress = 0.3, kStiffening = 4.0;
constexpr int kMaxMultiplierUpdates = 60;
// A barrier that lets something nearer than the first, × d̂, gets so much stiffer that about the second should be left
// of the same force (κ b′ ~ κ/d there), but no more than so many times at once, and in all.
constexpr double kNear = 0.01, kFarEnough = 0.05, kMostStiffening = 10.0, kStiffest = 1e4;

double largest_row(const Positions& p, Eigen::Index rows) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < rows; ++i) largest = std::max(largest, p.row(i).squaredNorm());
  return std::sqrt(largest);
}

FreeVertices free_vertices(const ContactMesh& mesh, const std::vector<int>& glued, bool augmented_lagrangian) {
  std::vector<bool> fixed(static_cast<std::size_t>(mesh.num_vertices()), false);
  // Neighbours near each other: matrix and vectors are gone through from one end to the other, again and again.
  std::vector<int> order = spatial_order(mesh.rest_positions.topRows(mesh.num_gel_vertices));
  for (int v = mesh.num_gel_vertices; v < mesh.num_vertices(); ++v) order.push_back(v);
  if (augmented_lagrangian) return {order, fixed};
  for (int v = mesh.num_gel_vertices; v < mesh.num_vertices(); ++v) fixed[v] = true;
  for (const int v : glued) fixed[v] = true;
  return {order, fixed};
}

}  // namespace

void lean_on_farthest(const Positions& p, Blend& blend) {
  const double far = kFarthest * largest_row(p, p.rows());
  for (Eigen::Index v = 0; v < p.rows(); ++v) {
    if (p.row(v).norm() >= far) blend.shortened(static_cast<int>(v));
  }
}

TimeStepper::TimeStepper(const ContactMesh& mesh, GelModel gel, const StepSettings& settings)
    : mesh_(mesh),
      gel_(std::move(gel)),
      settings_(settings),
      search_(mesh),
      newton_(free_vertices(mesh, gel_.glued, settings.augmented_lagrangian), mesh.num_gel_vertices,
              mesh_pattern(free_vertices(mesh, gel_.glued, settings.augmented_lagrangian), *gel_.elasticity),
              settings.linear_solver) {
  std::vector<bool> held(static_cast<std::size_t>(mesh.num_vertices()), false);
  for (const int v : gel_.glued) held[v] = true;
  elasticity_at_mount_ = restricted(gel_.elasticity, held);
}

IncrementalPotential TimeStepper::potential(const Step& step, std::vector<ContactPair> pairs) const {
  StepTerms terms = step.terms;
  terms.friction = step.friction;
  terms.barrier = std::make_shared<ContactBarrier>(barrier(std::move(pairs)));
  return make_incremental_potential(terms, step.weights);
}

ContactBarrier TimeStepper::barrier(std::vector<ContactPair> pairs) const {
  return {mesh_, weighted(std::move(pairs), mesh_, settings_.pair_counting), settings_.d_hat_m};
}

std::vector<ContactPair> TimeStepper::pairs_at(const Positions& x) {
  if (last_look_.x.rows() != x.rows() || (last_look_.x.array() != x.array()).any())
    last_look_ = {x, pairs_along(x, Positions::Zero(x.rows(), 3))};
  return last_look_.pairs;
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
  return all;
}

void TimeStepper::minimise(Step& step) {
  const Eigen::Index n = mesh_.num_gel_vertices;
  const double h = step.goal.h_s;
  const NewtonSettings& newton = settings_.newton;
  const Positions still = Positions::Zero(step.x.rows(), 3);
  Positions& x = step.x;
  StepReport& report = step.report;
  int relax = 0, relax_wanted = 0, iterations = 0, waited = 0;
  double last_residual = std::numeric_limits<double>::infinity();
  IncrementalPotential energy = potential(step, pairs_at(x));
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  double value_here = kUnknown;  // of the energy, where the last line search found it

  while (true) {
    if (iterations >= newton.max_iterations) {
      throw SolverError(
          "Newton did not converge within {} iterations (step {:.2e} m/s, limit {:.2e}, residual force {:.2e} N "
          "of {:.3e} N, smallest gap {:.2e} m)",
          newton.max_iterations, report.velocity_residual_m_s, newton.velocity_tolerance_m_s, report.force_residual_n,
          report.contact_force_n, smallest_gap(x, settings_.d_hat_m));
    }
    const bool moving = !step.arrived && relax == 0;
    Positions motion = still;
    if (moving) {
      motion.bottomRows(mesh_.num_object_vertices) =
          (step.goal.object_target - x.bottomRows(mesh_.num_object_vertices)).rowwise() + step.yield.transpose();
    }
    Blend leaning = step.arrived ? step.blend : Blend(mesh_.num_gel_vertices, newton.adaptive_contact_hessian);
    // The next direction differs from this one by more than what is left out of it; but on the object's way, where no
    // energy guards the step, the last part of it counts.
    const bool rough = step.arrived || last_residual > kFar * newton.velocity_tolerance_m_s;
    newton_.set_tolerance(rough ? kRoughDirection : kFineDirection);
    const double longest = moving ? std::numeric_limits<double>::infinity() : kTooLong * last_residual * h;
    const NewtonDirection direction = newton_.direction(energy, x, motion, step.goal.yielding, longest, leaning);
    if (step.arrived) step.blend = leaning;
    ++iterations;
    ++report.newton_iterations;
    last_residual =
        std::max(largest_row(direction.p, settings_.augmented_lagrangian ? x.rows() : n), direction.yield.norm()) / h;
    report.velocity_residual_m_s = last_residual;
    report.force_residual_n = direction.gradient_sum / (h * h);
    report.contact_force_n = direction.contact_sum / (h * h);

    // Multipliers see their targets missed no finer than the minimum is known.
    bool done = false;
    const bool held = !step.constraint || step.constraint->largest(direction.p) < 0.3 * kConstraintTolerance;
    if (step.arrived && held && last_residual < step.looseness * newton.velocity_tolerance_m_s) {
      done =
          report.force_residual_n <
          step.looseness * std::max(newton.force_tolerance_n, newton.relative_force_tolerance * report.contact_force_n);
      // A stand-in shortens steps: a vertex on the crest of one of the object's edges looks at rest by them. With the
      // exact Hessian it would not, so that is waited for, a while.
      const bool exact = direction.blend == 0.0 || !newton.adaptive_contact_hessian;
      if (done && (exact || step.looseness > 1.0 || ++waited > kMaxWait)) return;
    }

    std::vector<ContactPair> pairs = pairs_along(x, direction.p);
    double alpha = timed(times_.limits_s, [&] {
      const GapRule rule{moving ? kMovingSlack : kNewtonSlack, kGapFloor * settings_.d_hat_m};
      return std::min(contact_step_limit(pairs, x, direction.p, rule), inversion_step_limit(gel_.tets, x, direction.p));
    });
    const double limit = alpha;
    energy = potential(step, std::move(pairs));
    if (moving) {
      ++report.moving_iterations;
      x += alpha * direction.p;
      value_here = kUnknown;
      step.yield += alpha * direction.yield;
      if (alpha == 1.0) {
        step.arrived = true;
        x.bottomRows(mesh_.num_object_vertices) = step.goal.object_target.rowwise() + step.yield.transpose();
      }
      // The shorter the object's move, the more the gel is let go of it before the next.
      relax_wanted = alpha < 0.1   ? std::clamp(2 * relax_wanted, 2, 16)
                     : alpha > 0.3 ? relax_wanted / 2
                                   : std::max(1, relax_wanted);
      relax = relax_wanted;
    } else {
      const auto value = [&](const Positions& at) {
        return timed(times_.line_search_s, [&] { return energy.value(at); });
      };
      const double before = std::isnan(value_here) ? value(x) : value_here;
      // Near the minimum the decrease drowns in rounding; a step that changes nothing measurable is then a step forward
      // too.
      const double noise = 1e-14 * std::abs(before);
      int halvings = 0;
      Positions trial = x + alpha * direction.p;
      while (value_here = value(trial), !(value_here <= before + 1e-4 * alpha * direction.slope + noise)) {
        if (++halvings > kMaxHalvings) {
          if (done) return;  // what was waited for is below rounding
          throw SolverError("line search found no decrease (step {:.2e} m/s, slope {:.2e}, smallest gap {:.2e} m)",
                            last_residual, direction.slope, smallest_gap(x, settings_.d_hat_m));
        }
        alpha *= 0.5;
        trial = x + alpha * direction.p;
      }
      // A step too long for the energy: lean on the stand-in again, which is never too soft.
      if (step.arrived && halvings > 0) lean_on_farthest(direction.p.topRows(n), step.blend);
      x = trial;
      step.yield += alpha * direction.yield;
      if (!step.arrived) --relax;
      if (step.arrived && !done && relax_patch(step, direction)) {
        energy = potential(step, pairs_at(x));
        value_here = kUnknown;
      }
    }
    log_debug("  {} {:3d}: alpha {:.3g} (limit {:.3g}) step {:.3e} m/s residual {:.3e} N blend {:.3g}",
              moving         ? "move"
              : step.arrived ? "newton"
                             : "relax",
              report.newton_iterations, alpha, limit, last_residual, report.force_residual_n, direction.blend);
    step.observe(report.newton_iterations, last_residual);
  }
}

/// Minimises with the constraints of an augmented Lagrangian, renewing its multipliers until all targets are met.
void TimeStepper::minimise_constrained(Step& step) {
  minimise(step);
  double last_miss = std::numeric_limits<double>::infinity();
  for (int update = 0; step.constraint; ++update) {
    const double miss = largest_row(step.constraint->misses(step.x), step.constraint->num_stencils());
    if (miss <= kConstraintTolerance) return;
    if (update == kMaxMultiplierUpdates) {
      throw SolverError("the augmented Lagrangian left a vertex {:.2e} m from its target after {} renewals", miss,
                        kMaxMultiplierUpdates);
    }
    // Contact that is stiffer than the pull makes multipliers creep: pull harder.
    const double stiffening = miss > kSlowProgress * last_miss ? kStiffening : 1.0;
    step.constraint = std::make_shared<Dirichlet>(step.constraint->renewed(step.x, stiffening));
    last_miss = miss;
    step.terms.constraint = step.constraint;
    minimise(step);
  }
}

bool TimeStepper::stiffen_barrier(State& state, const Positions& x) {
  if (!settings_.adaptive_barrier || state.barrier_factor >= kStiffest) return false;
  const double gap = smallest_gap(x, settings_.d_hat_m) / settings_.d_hat_m;
  if (gap >= kNear) return false;
  state.barrier_factor = std::min(kStiffest, std::min(kMostStiffening, kFarEnough / gap) * state.barrier_factor);
  log_debug("  smallest gap {:.2g} of the barrier's reach: {:.3g} times as stiff from here on", gap,
            state.barrier_factor);
  return true;
}

StepReport TimeStepper::advance(State& state, const StepGoal& goal, const IterationObserver& observe) {
  StepReport report = try_to_advance(state, goal, observe);
  report.barrier_factor = state.barrier_factor;
  stiffen_barrier(state, state.x);
  return report;
}

StepReport TimeStepper::try_to_advance(State& state, const StepGoal& goal, const IterationObserver& observe) {
  const Eigen::Index n = mesh_.num_gel_vertices;
  const double h = goal.h_s;
  const Positions start = state.x.topRows(n);
  newton_.reset_pattern();
  search_.forget();
  last_look_ = {};

  Step step{.goal = goal,
            .observe = observe,
            .start = state.x,
            .x = state.x,
            .blend = Blend(mesh_.num_gel_vertices, settings_.newton.adaptive_contact_hessian)};
  step.report.time_steps = 1;
  step.arrived = (state.x.bottomRows(mesh_.num_object_vertices) - goal.object_target).cwiseAbs().maxCoeff() == 0.0;
  step.weights = {.h_s = h,
                  .barrier_stiffness_j_m4 = state.barrier_factor * settings_.barrier_stiffness_j_m4,
                  .friction_coefficient = settings_.friction ? settings_.friction->coefficient : 0.0,
                  .mass_damping_per_s = settings_.mass_damping_per_s,
                  .stiffness_damping_s = settings_.stiffness_damping_s};
  if (settings_.augmented_lagrangian) {
    std::vector<int> vertices = gel_.glued;
    for (int v = 0; v < mesh_.num_object_vertices; ++v) vertices.push_back(static_cast<int>(n) + v);
    Positions targets(static_cast<Eigen::Index>(vertices.size()), 3);
    for (std::size_t i = 0; i < gel_.glued.size(); ++i)
      targets.row(static_cast<Eigen::Index>(i)) = mesh_.rest_positions.row(gel_.glued[i]);
    targets.bottomRows(mesh_.num_object_vertices) = goal.object_target;
    const double stiffness =
        kConstraintStiffness * step.weights.barrier_stiffness_j_m4 * settings_.d_hat_m * settings_.d_hat_m;
    const Positions none = Positions::Zero(targets.rows(), 3);
    step.constraint = std::make_shared<Dirichlet>(std::move(vertices), std::move(targets), none, stiffness);
    step.terms.constraint = step.constraint;
    step.arrived = true;  // the energy pulls the object along
  }
  step.terms.elasticity = gel_.elasticity;
  const Eigen::RowVector3d fall = h * h * settings_.gravity_m_s2.transpose();
  if (!settings_.quasi_static) {
    step.terms.inertia = std::make_shared<Inertia>(gel_.mass_kg, (start + h * state.velocity_m_s).rowwise() + fall);
  }
  if (settings_.quasi_static && settings_.gravity_m_s2 != Vector3::Zero()) {
    std::vector<int> all(static_cast<std::size_t>(n));
    std::iota(all.begin(), all.end(), 0);
    step.terms.gravity =
        std::make_shared<LinearLoad>(std::move(all), gel_.mass_kg * settings_.gravity_m_s2.transpose());
  }
  if (settings_.stiffness_damping_s > 0.0)
    step.terms.stiffness_damping = std::make_shared<StiffnessDamping>(gel_.elasticity, start);
  if (settings_.mass_damping_per_s > 0.0) step.terms.mass_damping = std::make_shared<Inertia>(gel_.mass_kg, start);
  if (!goal.yielding.empty()) {
    const Eigen::RowVector3d x_hat = state.x.row(n) + h * state.object_velocity_m_s.transpose() + fall +
                                     h * h / goal.object_mass_kg * goal.load_n.transpose();
    step.terms.object_inertia = std::make_shared<Inertia>(Eigen::VectorXd::Constant(1, goal.object_mass_kg),
                                                          Positions(x_hat), static_cast<int>(n));
  }
  start_friction(step);

  try {
    minimise_constrained(step);
    settle_friction(step);
  } catch (const SolverError& error) {
    // A gap that is all but closed is too stiff a spring beside all others; with a stiffer barrier it stays wider.
    if (!stiffen_barrier(state, step.x)) throw;
    log_info("{}; again with {:.3g} times the barrier", error.what(), state.barrier_factor);
    return try_to_advance(state, goal, observe);
  }

  record_forces(step);
  step.report.yield_m = step.yield;
  if (settings_.quasi_static) {
    state.velocity_m_s.setZero();
  } else {
    state.velocity_m_s = (step.x.topRows(n) - start) / h;
  }
  state.object_velocity_m_s.setZero();
  for (const int axis : goal.yielding) state.object_velocity_m_s[axis] = step.yield[axis] / h;
  state.x = std::move(step.x);
  if (!settings_.augmented_lagrangian)
    state.x.bottomRows(mesh_.num_object_vertices) = goal.object_target.rowwise() + step.yield.transpose();
  return step.report;
}

double TimeStepper::smallest_gap(const Positions& x, double none) {
  // Where anything touches, what the barrier sees suffices: looking farther finds many times as many pairs.
  std::vector<ContactPair> pairs = pairs_at(x);
  std::erase_if(pairs, [&](const ContactPair& pair) {
    return std::all_of(pair.vertices.begin(), pair.vertices.end(), [&](int v) { return v < mesh_.num_gel_vertices; });
  });
  const double near = smallest_distance(pairs, x, none);
  if (near < std::min(settings_.d_hat_m, none)) return near;
  return smallest_distance(search_.object_pairs(x, Positions::Zero(x.rows(), 3), none), x, none);
}

}  // namespace tacipc
