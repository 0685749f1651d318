#include "stages/gel/press/solve/lagged_friction.h"

#include <algorithm>
#include <limits>

#include "common/base/error.h"
#include "common/base/log.h"
#include "stages/gel/press/solve/assembly.h"
#include "stages/gel/press/solve/held_objects.h"

namespace tacipc {
namespace {

// Updates before Newton iterations end when one changes friction by less than kSettledPart of the limit, or when
// kMostRenewals in a row have not halved the change. In the second case the last update is not made.
constexpr double kSettledPart = 0.1;
constexpr int kMostRenewals = 6;
// An update is also skipped if it would change friction by more than kJump times the least change so far, once that was
// within the limit: vertices are then moving over an edge, with forces that do not last.
constexpr double kJump = 3.0;
// Friction that was updated before iterations is updated at minima until its residual is below kStrictPart of the
// limit; after kStrictRenewals such updates the limit itself suffices.
constexpr double kStrictPart = 0.3;
constexpr int kStrictRenewals = 8;
constexpr double kLagSlack = 0.5;  // fraction of each gap that is left if friction is lagged once
// kLooseness is the factor on the tolerances until friction has first been updated at a minimum, and after the strict
// updates while friction is far from settled: residual above kFarFromSettled times the limit.
constexpr double kLooseness = 10.0, kFarFromSettled = 5.0;
// Strict updates leave minima early: residual forces need only fall to the change just made, with tolerances at most
// this many times as loose. Not with free bodies, because their balance determines their position.
constexpr double kMostLooseness = 40.0;
// If a residual is more than kSlowRenewal of the last one, updates converge too slowly. Then only half of the new
// friction is mixed in, then a quarter, and so on, at least kSmallestRenewal.
constexpr double kSlowRenewal = 0.8, kSmallestRenewal = 0.1;

}  // namespace

std::shared_ptr<const Friction> LaggedFriction::lagged_at(const Positions& x, ActiveBarrier& barrier,
                                                          const Step& step) const {
  return std::make_shared<const Friction>(*barrier.barrier(), barrier.at(x), x, step.compared_start(),
                                          model_.settings.friction->speed_threshold_m_s * step.goal.h_s);
}

std::shared_ptr<const Friction> LaggedFriction::lagged_at(const Positions& x, const Step& step) {
  ActiveBarrier barrier(model_.barrier(detector_.pairs_at(x)));
  return lagged_at(x, barrier, step);
}

void LaggedFriction::start(Step& step) {
  if (!model_.settings.friction) return;
  if (model_.settings.friction->max_lag_iterations > 1) {
    step.friction = lagged_at(step.start, step);
    if (model_.settings.friction->renewed_only_at_minima || model_.settings.augmented_lagrangian) {
      step.looseness = kLooseness;
    } else {
      step.renewals_left = kMostRenewals;
    }
    return;
  }
  // Friction is lagged at the positions after the objects alone have moved as far as half of every gap allows, so that
  // contacts of this step also have friction, as in the IPC authors' code.
  Positions motion = way_of_held_objects(model_.mesh, step, step.start);
  for (const Step::Body& body : step.bodies) {
    const int first = model_.mesh.control_row(body.body);
    motion.middleRows<4>(first) = body.predicted - step.start.middleRows<4>(first);
  }
  for (const CarriedBody& body : step.newton.free().carried) body.carry(motion);
  // Near pairs usually stop the object soon; the other pairs need to be searched only up to there.
  GapRule rule = detector_.gap_rule(kLagSlack);
  rule.near_m = std::numeric_limits<double>::infinity();
  const double part = contact_step_limit(detector_.pairs_at(step.start), step.start, motion, rule);
  motion *= part;
  motion *= contact_step_limit(detector_.pairs_along(step.start, motion), step.start, motion, rule);
  step.friction = lagged_at(step.start + motion, step);
}

double LaggedFriction::change(const Friction& renewed, const Step& step) const {
  const Positions difference = gradient_of(renewed, step.x) - gradient_of(*step.friction, step.x);
  double sum = 0.0;
  for (const int v : step.newton.free().vertex_of_free) sum += difference.row(v).norm();
  for (const CarriedBody& body : step.newton.free().carried)
    sum += difference.middleRows(body.first_vertex, body.weights.rows()).colwise().sum().norm();
  return step.weights.of_friction(1.0) * sum;
}

double LaggedFriction::limit(const Step& step) const {
  return std::max(model_.settings.newton.force_tolerance_n,
                  model_.settings.friction->relative_lag_tolerance * step.report.contact_force_n);
}

void LaggedFriction::renew(Step& step, Minimisation& run) const {
  auto renewed = lagged_at(step.x, run.active, step);
  if (step.arrived) {
    const double changed = change(*renewed, step);
    log_debug("  renewal {}: {:.3e} N", step.report.lag_iterations + 1, changed);
    if (changed < 0.5 * step.least_friction_change_n) {
      step.least_friction_change_n = changed;
      step.renewals_left = kMostRenewals;
    }
    const bool last = --step.renewals_left == 0;  // vertices oscillate: only constant friction ends that
    if (last && step.bodies.empty()) step.looseness = kLooseness;
    const double least = step.least_friction_change_n;
    if (last || (least <= limit(step) && changed > kJump * least)) return;
    if (changed <= kSettledPart * limit(step)) step.renewals_left = 0;  // this is the last one
  }
  ++step.report.lag_iterations;
  step.friction = std::move(renewed);
  run.energy = step.potential(run.active.barrier());
  run.value.reset();
}

void LaggedFriction::settle(Step& step, const std::function<void()>& minimise) {
  if (!model_.settings.friction) return;
  const FrictionSettings& friction = *model_.settings.friction;
  StepReport& report = step.report;
  double renewal = 1.0, last_residual = std::numeric_limits<double>::infinity();
  int renewed_here = 0;
  while (true) {
    // Residual force if friction were updated now.
    const auto renewed = lagged_at(step.x, step);
    report.friction_residual_n = change(*renewed, step);
    log_debug("  lag {:3d}: residual {:.3e} N of {:.3e} N", report.lag_iterations, report.friction_residual_n,
              report.contact_force_n);
    const double allowed = limit(step);
    // Friction is updated at least once: else some steps would keep older friction than others, and forces would jump
    // between them by up to the tolerance.
    const bool renewed_once = report.lag_iterations > 0 || friction.max_lag_iterations == 1;
    const bool strict = !friction.renewed_only_at_minima && renewed_here < kStrictRenewals;
    const bool settled = report.friction_residual_n <= (!renewed_once ? model_.settings.newton.force_tolerance_n
                                                        : strict      ? kStrictPart * allowed
                                                                      : allowed);
    const bool early = strict && step.bodies.empty();
    const bool last = renewed_here + 1 >= friction.max_lag_iterations;
    if ((settled || last) && step.looseness == 1.0) {
      if (settled || friction.max_lag_iterations == 1) return;
      throw SolverError(
          "friction did not settle: residual {:.2e} N after it was renewed {} times at minima (limit {:.2e})",
          report.friction_residual_n, friction.max_lag_iterations, allowed);
    }
    if (!settled && !last) {
      ++renewed_here;
      if (report.friction_residual_n > kSlowRenewal * last_residual)
        renewal = std::max(0.5 * renewal, kSmallestRenewal);
      if (early && renewed_here == kStrictRenewals) renewal = 1.0;  // leaving minima early may have slowed convergence
      last_residual = report.friction_residual_n;
    }
    if (renewed_once || !settled) {  // also before the last minimum, which is sought in full anyway
      ++report.lag_iterations;
      step.friction = renewal == 1.0 ? renewed : step.friction->mixed_with(*renewed, renewal);
    }
    if (settled || last) {
      step.looseness = 1.0;
    } else if (early) {
      const double changed = renewal * report.friction_residual_n;
      step.looseness =
          std::clamp(changed / model_.settings.newton.force_limit_n(report.contact_force_n), 1.0, kMostLooseness);
    } else {
      step.looseness = report.friction_residual_n > kFarFromSettled * allowed ? kLooseness : 1.0;
    }
    minimise();
  }
}

}  // namespace tacipc
