#include "stages/gel/press/solve/minimise.h"

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/base/log.h"
#include "stages/gel/press/solve/head_start.h"
#include "stages/gel/press/solve/held_objects.h"
#include "stages/gel/press/solve/line_search.h"

namespace tacipc {
namespace {

// Tolerances of the linear solver. The fine one is for moves, which no line search guards: an error there costs more
// iterations later than it saves. The loose one is used while friction is still to be updated.
constexpr double kLooseSolve = 3e-2, kCoarseSolve = 1e-2, kFineSolve = 1e-3;
// A step this many times as long as the last one indicates a nearly indefinite Hessian.
constexpr double kLengthGrowth = 4.0;
constexpr int kMaxExactHessianWaits = 10;
// Limit of the force residual of a free body, as a fraction of its weight or load, at least kLeastWeight; for torques
// with the lever arm kBodyTorqueArm_m.
constexpr double kBodyTolerance = 5e-4;
// After this many consecutive full steps with an approximated Hessian, each step is twice as long as the one before.
constexpr int kCreeping = 6;
constexpr double kMostStretch = 1e3;
// Multipliers are updated at minima that are accurate to this fraction of the constraint's tolerance.
constexpr double kConstraintPart = 0.3;

/// Lengthens the next step if the steps before it were small.
void stretch_next(Minimisation& run, const NewtonDirection& direction, double alpha) {
  // If a body is about to fall over, its energy has no minimum nearby, but the approximated energy has one, so every
  // step is short.
  if (alpha < 1.0) {
    run.stretch = std::max(1.0, 0.5 * run.stretch);
  } else if (direction.largest_share > 0.0) {
    if (++run.crept >= kCreeping) run.stretch = std::min(2.0 * run.stretch, kMostStretch);
    return;
  }
  if (direction.largest_share == 0.0) run.stretch = 1.0;
  run.crept = 0;
}

}  // namespace

void Minimiser::minimise(Step& step) {
  const StepReport& report = step.report;
  Minimisation run{.active = ActiveBarrier(model_.barrier(detector_.pairs_at(step.x))), .energy = {}};
  run.energy = step.potential(run.active.barrier());
  while (true) {
    if (report.newton_iterations >= model_.settings.newton.max_iterations) {
      throw SolverError(
          "Newton did not converge within {} iterations (step {:.2e} m/s, limit {:.2e}, residual force {:.2e} N "
          "of {:.3e} N, smallest gap {:.2e} m)",
          model_.settings.newton.max_iterations, report.velocity_residual_m_s,
          model_.settings.newton.velocity_tolerance_m_s, report.force_residual_n, report.contact_force_n,
          detector_.smallest_gap(step.x, model_.settings.laws.reach_m()));
    }
    const bool moving = !step.arrived && !run.relax_next;
    // In the first iteration, friction is already lagged at x.
    if (step.renewals_left > 0 && report.newton_iterations > 0) friction_.renew(step, run);
    NewtonDirection direction = find_direction(step, run, moving);
    const bool converged = within_tolerances(step, direction);
    step.report.approximated_share = direction.largest_share;
    if (converged && is_final(step, run, direction)) return;

    if ((step.goal.free_object || model_.mesh.gels.size() > 1) && !moving) {
      // The Newton step of a light object may be long before it touches anything.
      if (const double way = relative_way(model_.mesh, direction.p), most = longest_way(model_.settings); way > most) {
        direction.p *= most / way;
        direction.slope *= most / way;
      }
    }
    if (!moving && run.stretch > 1.0) {
      direction.p *= run.stretch;
      direction.slope *= run.stretch;
    }
    std::vector<ContactPair> pairs = detector_.pairs_along(step.x, direction.p);
    const double limit = moving ? mover_.bend_at_contacts(step, run, direction, pairs)
                                : detector_.step_limit(pairs, step.x, direction.p, kNewtonSlack);
    run.active = ActiveBarrier(model_.barrier(pairs));
    run.energy = step.potential(run.active.barrier());
    double alpha = limit;
    const char* const kind = moving ? "move" : step.arrived ? "newton" : "relax";
    if (moving) {
      mover_.move(step, run, direction, alpha);
    } else {
      const std::optional<double> found = line_search(direction, limit, step, run, times_);
      if (!found && converged) return;  // the exact Hessian could change the energy only below rounding
      if (!found) {
        throw SolverError("line search found no decrease (step {:.2e} m/s, slope {:.2e}, smallest gap {:.2e} m)",
                          run.residual_m_s, direction.slope,
                          detector_.smallest_gap(step.x, model_.settings.laws.reach_m()));
      }
      alpha = *found;
      run.relax_next = false;
      if (!step.bodies.empty()) stretch_next(run, direction, alpha);
      if (const auto change = step.arrived ? patches_.relax(step, direction, pairs) : std::nullopt) {
        run.active = ActiveBarrier(model_.barrier(std::move(pairs)));
        run.energy = step.potential(run.active.barrier());
        *run.value += *change;
      }
    }
    log_debug("  {} {:3d}: alpha {:.3g} (limit {:.3g}) step {:.3e} m/s residual {:.3e} N blend {:.3g}", kind,
              report.newton_iterations, alpha, limit, run.residual_m_s, report.force_residual_n,
              direction.largest_share);
    step.observe(report.newton_iterations, run.residual_m_s);
  }
}

NewtonDirection Minimiser::find_direction(Step& step, Minimisation& run, bool moving) const {
  const double h = step.goal.h_s;
  const Positions way = moving ? way_of_held_objects(model_.mesh, step, step.x) : Positions();
  Positions motion = Positions::Zero(step.x.rows(), 3);
  if (moving && step.goal.gel_motion.size() > 0)
    motion.topRows(model_.mesh.num_gel_vertices) = run.part_of_motion * step.gel_way_left * step.goal.gel_motion;
  if (moving) model_.mesh.object_rows(motion) = run.part_of_motion * model_.mesh.object_rows(way);
  // Successive directions differ by more than the error of a coarse solution.
  const bool loose =
      step.looseness > 1.0 && step.bodies.empty() && step.goal.free_axes.empty() && model_.mesh.gels.size() <= 1;
  step.newton.set_tolerance(moving ? kFineSolve : loose ? kLooseSolve : kCoarseSolve);
  const double longest_m = moving ? std::numeric_limits<double>::infinity() : kLengthGrowth * run.residual_m_s * h;
  Blend from_psd = model_.full_blend();
  NewtonDirection direction =
      step.newton.direction({run.energy, step.x, motion, step.goal.free_axes, longest_m, &run.active.at(step.x)},
                            step.arrived ? step.blend : from_psd);
  const Eigen::Index rows = model_.settings.augmented_lagrangian ? step.x.rows() : model_.mesh.num_gel_vertices;
  run.residual_m_s = std::max(largest_row(direction.p, rows), direction.object_shift.norm());
  for (const Step::Body& body : step.bodies) {
    const auto points = direction.p.middleRows<4>(model_.mesh.control_row(body.body));
    run.residual_m_s = std::max(run.residual_m_s, std::sqrt(points.rowwise().squaredNorm().sum()));
  }
  run.residual_m_s /= h;
  StepReport& report = step.report;
  ++report.newton_iterations;
  report.velocity_residual_m_s = run.residual_m_s;
  report.force_residual_n = direction.gradient_sum / (h * h);
  report.contact_force_n = direction.contact_sum / (h * h);
  if (direction.gels.size() > 1) {
    const auto limit = [&](double contact_sum) { return model_.settings.newton.force_limit_n(contact_sum / (h * h)); };
    double worst = 0.0;
    for (const NewtonDirection::Gel& gel : direction.gels)
      worst = std::max(worst, gel.gradient_sum / (h * h) / limit(gel.contact_sum));
    report.force_residual_n = worst * limit(direction.contact_sum);
  }
  return direction;
}

bool Minimiser::within_tolerances(const Step& step, const NewtonDirection& direction) const {
  const NewtonSettings& settings = model_.settings.newton;
  const StepReport& report = step.report;
  if (!step.arrived) return false;
  if (step.constraint && !(step.constraint->largest(direction.p) < kConstraintPart * kConstraintTolerance))
    return false;
  if (!(report.velocity_residual_m_s < step.looseness * settings.velocity_tolerance_m_s)) return false;
  for (std::size_t b = 0; b < step.bodies.size(); ++b) {
    // Within the gel's tolerance, the weight of a light object would not matter.
    const double h2 = step.goal.h_s * step.goal.h_s,
                 limit = kBodyTolerance * std::max(step.bodies[b].weight_n, kLeastWeight) * step.looseness;
    if (!(direction.bodies[b].force / h2 < limit && direction.bodies[b].torque / h2 < limit * kBodyTorqueArm_m))
      return false;
  }
  return report.force_residual_n < step.looseness * settings.force_limit_n(report.contact_force_n);
}

// The PSD approximation shortens steps, so that a vertex on the crest of an edge of the object seems to be at rest,
// although it would not be with the exact Hessian. A limited number of iterations waits for the exact Hessian.
bool Minimiser::is_final(Step& step, Minimisation& run, const NewtonDirection& direction) const {
  const bool exact = direction.largest_share == 0.0 || !model_.settings.newton.adaptive_contact_hessian;
  if (exact || step.looseness > 1.0 || run.exact_hessian_waits == kMaxExactHessianWaits) return true;
  ++run.exact_hessian_waits;
  ++step.report.exact_hessian_waits;
  return false;
}

}  // namespace tacipc
