#include "stages/gel/press/solve/lagged_friction.h"

#include <algorithm>
#include <limits>

#include "common/base/error.h"
#include "common/base/log.h"
#include "stages/gel/press/solve/assembly.h"
#include "stages/gel/press/solve/held_objects.h"

namespace tacipc {
namespace {

// Renewals before iterations of Newton's method end with one that changes less than this part of the limit, or where
// this many in a row have not halved the change: the last of these is not made.
constexpr double kSettledPart = 0.1;
constexpr int kMostRenewals = 6;
// Nor is one made that would change more than so many times as much as the least so far, where that was within the
// limit: vertices are on their way over an edge, with forces that do not last.
constexpr double kJump = 3.0;
// Friction that such renewals left is renewed at minima until its residual is below this part of the limit, too; after
// so many of these the limit itself will do.
constexpr double kStrictPart = 0.3;
constexpr int kStrictRenewals = 8;
constexpr double kLagSlack = 0.5;  // part of each gap left where friction is lagged once
// Factor on the tolerances until friction has first been renewed at a minimum, and after the strict renewals as long as
// friction is far from settled: its residual so many times the limit.
constexpr double kLooseness = 10.0, kFarFromSettled = 5.0;
// The strict renewals leave minima early: residual forces are brought to what has just been changed, with tolerances at
// most so many times as loose. Not beside bodies that move freely: their balance says where they are.
constexpr double kMostLooseness = 40.0;
// Where a residual is more than this part of the last one, renewals converge too slowly: then only half of the new
// friction is mixed in, a quarter, …, at least the second.
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
  // Normal forces and tangent planes are those after the object alone has moved as far as half of every gap allows, so
  // that contacts of this step have friction, too. [where the IPC authors' code lags friction]
  Positions motion = way_of_held_objects(model_.mesh, step, step.start);
  for (const Step::Body& body : step.bodies) {
    const int first = model_.mesh.control_row(body.body);
    motion.middleRows<4>(first) = body.predicted - step.start.middleRows<4>(first);
  }
  for (const CarriedBody& body : step.newton.free().carried) body.carry(motion);
  // Pairs that are near already mostly stop the object soon; only up to there the others need be searched.
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
    const bool last = --step.renewals_left == 0;  // vertices go to and fro: only friction that stays ends that
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
    // The residual force if normal forces and tangent planes were renewed now.
    const auto renewed = lagged_at(step.x, step);
    report.friction_residual_n = change(*renewed, step);
    log_debug("  lag {:3d}: residual {:.3e} N of {:.3e} N", report.lag_iterations, report.friction_residual_n,
              report.contact_force_n);
    const double allowed = limit(step);
    // Renewed once at least: else some steps would keep older friction than others, and forces would jump between them
    // by as much as the tolerance allows.
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
      if (early && renewed_here == kStrictRenewals) renewal = 1.0;  // that minima were left early may have slowed it
      last_residual = report.friction_residual_n;
    }
    if (renewed_once || !settled) {  // before the last minimum, too, which is sought in full anyway
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
