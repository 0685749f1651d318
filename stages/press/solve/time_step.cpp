#include "stages/press/solve/time_step.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/log.h"
#include "stages/press/solve/step_limit.h"

namespace tacipc {
namespace {

constexpr double kMovingSlack = 0.3;  // gaps kept while the object moves, where no energy guards the step
constexpr double kNewtonSlack = 0.1;
constexpr double kGapFloor = 1e-4;  // × d̂
// How the share of the contact Hessian's positive stand-in adapts: as small as the factorisation lets it be.
constexpr double kFirstBlend = 0.02, kBlendGrowth = 3.0, kBlendShrink = 2.0;
constexpr int kMaxHalvings = 40;

const ContactBarrier& barrier_of(const IncrementalPotential& potential) {
  return static_cast<const ContactBarrier&>(*potential.terms.back().term);
}

/// Σᵢ |row i| of a vector of stacked triples.
double sum_of_norms(const Eigen::VectorXd& stacked) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < stacked.size(); i += 3) sum += stacked.segment<3>(i).norm();
  return sum;
}

double largest_row(const Positions& p, Eigen::Index rows) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < rows; ++i) largest = std::max(largest, p.row(i).squaredNorm());
  return std::sqrt(largest);
}

}  // namespace

/// A Newton step and what was learnt on the way to it.
struct TimeStepper::Direction {
  Positions p;   // all vertices: the gel's answer, the object's motion
  double slope;  // gᵀp over the free vertices
  double force_residual_n;
  double blend;  // part of the contact Hessian that was made positive: 0 exact, 1 all of it
};

TimeStepper::TimeStepper(const ContactMesh& mesh, GelModel gel, double h_s, double d_hat_m, double kappa,
                         const NewtonSettings& settings)
    : mesh_(mesh),
      gel_(std::move(gel)),
      h_s_(h_s),
      d_hat_m_(d_hat_m),
      kappa_(kappa),
      settings_(settings),
      search_(mesh),
      pattern_(mesh_pattern(gel_.free, *gel_.elasticity)) {}

IncrementalPotential TimeStepper::potential(const Positions& x_hat, std::vector<ContactPair> pairs) const {
  return make_incremental_potential(h_s_, kappa_, std::make_shared<Inertia>(gel_.mass_kg, x_hat), gel_.elasticity,
                                    std::make_shared<ContactBarrier>(mesh_, std::move(pairs), d_hat_m_));
}

TimeStepper::Direction TimeStepper::newton_direction(const IncrementalPotential& potential,
                                                     const ContactBarrier& barrier, const Positions& x,
                                                     const Positions& motion, double& blend, StepReport& report) {
  pattern_ = cover_contacts(pattern_, gel_.free, barrier, x);
  const WeightedTerm& contact = potential.terms.back();
  // Everything but contact, elasticity as told.
  const auto body = [&](Order elastic) {
    NewtonSystem system = empty_system(gel_.free, pattern_);
    for (std::size_t k = 0; k + 1 < potential.terms.size(); ++k)
      assemble(potential.terms[k], x, gel_.free, elastic, motion, system);
    return system;
  };
  const auto with_contact = [&](NewtonSystem system, Order order) {
    assemble(contact, x, gel_.free, order, motion, system);
    return system;
  };
  const auto solved = [&](const NewtonSystem& system, double used) {
    const Eigen::VectorXd step = solver_.solve(-system.gradient - system.coupling);
    Direction direction{motion, system.gradient.dot(step), sum_of_norms(system.gradient) / (h_s_ * h_s_), used};
    for (int i = 0; i < gel_.free.size(); ++i)
      direction.p.row(gel_.free.vertex_of_free[i]) = step.segment<3>(3 * i).transpose();
    return direction;
  };
  const auto factorized = [&](const BlockMatrix& matrix) {
    ++report.factorizations;
    return solver_.factorize(matrix);
  };
  const NewtonSystem elastic = body(Order::hessian);
  NewtonSystem positive = with_contact(elastic, Order::psd);
  if (blend < 1.0) {
    const NewtonSystem exact = with_contact(elastic, Order::hessian);
    const std::vector<double> positive_values = positive.hessian.values;
    for (; blend < 1.0; blend = blend == 0.0 ? kFirstBlend : kBlendGrowth * blend) {
      for (std::size_t k = 0; k < positive_values.size(); ++k) {
        positive.hessian.values[k] = exact.hessian.values[k] + blend * (positive_values[k] - exact.hessian.values[k]);
      }
      if (!factorized(positive.hessian)) continue;
      const double used = blend;
      blend = blend > kFirstBlend ? blend / kBlendShrink : 0.0;
      return solved(positive, used);
    }
    positive.hessian.values = positive_values;
    blend = 1.0;
  }
  const double used = blend;
  blend = 0.99 / kBlendShrink;
  if (factorized(positive.hessian)) return solved(positive, used);
  const NewtonSystem projected = with_contact(body(Order::psd), Order::psd);
  if (factorized(projected.hessian)) return solved(projected, used);
  throw SolverError("the projected Hessian is not positive definite");
}

StepReport TimeStepper::advance(Positions& x, Positions& velocity, const Positions& object_target,
                                const IterationObserver& observe) {
  const Eigen::Index n = mesh_.num_gel_vertices;
  const Positions start = x.topRows(n);
  const Positions x_hat = start + h_s_ * velocity;
  const Positions still = Positions::Zero(x.rows(), 3);
  StepReport report;
  bool arrived = (x.bottomRows(mesh_.num_object_vertices) - object_target).cwiseAbs().maxCoeff() == 0.0;
  int relax = 0, relax_wanted = 1;
  double blend = 1.0;
  double last_residual = std::numeric_limits<double>::infinity();
  IncrementalPotential energy = potential(x_hat, search_.pairs(x, still, d_hat_m_));

  while (true) {
    if (report.newton_iterations >= settings_.max_iterations) {
      report.contact_force_n = contact_forces(x).colwise().sum().norm();
      throw SolverError(
          "Newton did not converge within {} iterations (step {:.2e} m/s > {:.2e}, residual force {:.2e} N of {:.3e} "
          "N, smallest gap {:.2e} m)",
          settings_.max_iterations, report.velocity_residual_m_s, settings_.velocity_tolerance_m_s,
          report.force_residual_n, report.contact_force_n, smallest_gap(x, d_hat_m_));
    }
    const bool moving = !arrived && relax == 0;
    Positions motion = still;
    if (moving) motion.bottomRows(mesh_.num_object_vertices) = object_target - x.bottomRows(mesh_.num_object_vertices);
    double wanted = arrived ? blend : 1.0;
    const Direction step = newton_direction(energy, barrier_of(energy), x, motion, wanted, report);
    if (arrived) blend = wanted;
    ++report.newton_iterations;
    report.velocity_residual_m_s = last_residual = largest_row(step.p, n) / h_s_;
    report.force_residual_n = step.force_residual_n;

    if (arrived && last_residual < settings_.velocity_tolerance_m_s) {
      report.contact_force_n = contact_forces(x).colwise().sum().norm();
      if (step.force_residual_n <
          std::max(settings_.force_tolerance_n, settings_.relative_force_tolerance * report.contact_force_n))
        break;
    }

    std::vector<ContactPair> pairs = search_.pairs(x, step.p, d_hat_m_);
    double alpha =
        std::min(contact_step_limit(pairs, x, step.p, {moving ? kMovingSlack : kNewtonSlack, kGapFloor * d_hat_m_}),
                 inversion_step_limit(gel_.tets, x, step.p));
    const double limit = alpha;
    energy = potential(x_hat, std::move(pairs));
    if (moving) {
      ++report.moving_iterations;
      x += alpha * step.p;
      if (alpha == 1.0) {
        arrived = true;
        x.bottomRows(mesh_.num_object_vertices) = object_target;
      }
      // The shorter the object's move, the more the gel is let go of it before the next.
      relax_wanted = alpha < 0.1   ? std::min(2 * relax_wanted, 16)
                     : alpha > 0.3 ? std::max(1, relax_wanted / 2)
                                   : relax_wanted;
      relax = relax_wanted;
    } else {
      const double before = energy.value(x);
      // Near the minimum the decrease drowns in rounding; a step that changes nothing measurable is then a step forward
      // too.
      const double noise = 1e-14 * std::abs(before);
      int halvings = 0;
      Positions trial = x + alpha * step.p;
      while (!(energy.value(trial) <= before + 1e-4 * alpha * step.slope + noise)) {
        if (++halvings > kMaxHalvings) {
          throw SolverError("line search found no decrease (step {:.2e} m/s, slope {:.2e}, smallest gap {:.2e} m)",
                            last_residual, step.slope, smallest_gap(x, d_hat_m_));
        }
        alpha *= 0.5;
        trial = x + alpha * step.p;
      }
      x = trial;
      if (!arrived) --relax;
    }
    log_debug("  {} {:3d}: alpha {:.3g} (limit {:.3g}) step {:.3e} m/s residual {:.3e} N blend {:.3g}",
              moving    ? "move"
              : arrived ? "newton"
                        : "relax",
              report.newton_iterations, alpha, limit, last_residual, step.force_residual_n, step.blend);
    observe(report.newton_iterations, last_residual);
  }
  velocity = (x.topRows(n) - start) / h_s_;
  return report;
}

Positions TimeStepper::contact_forces(const Positions& x) {
  const ContactBarrier barrier(mesh_, search_.pairs(x, Positions::Zero(x.rows(), 3), d_hat_m_), d_hat_m_);
  return -kappa_ / (h_s_ * h_s_) * gradient_of(barrier, x).topRows(mesh_.num_gel_vertices);
}

Positions TimeStepper::mount_forces(const Positions& x) {
  Positions forces = gradient_of(*gel_.elasticity, x).topRows(mesh_.num_gel_vertices) - contact_forces(x);
  for (const int v : gel_.free.vertex_of_free) {
    if (v < mesh_.num_gel_vertices) forces.row(v).setZero();
  }
  return forces;
}

double TimeStepper::smallest_gap(const Positions& x, double none) {
  std::vector<ContactPair> pairs = search_.pairs(x, Positions::Zero(x.rows(), 3), none);
  std::erase_if(pairs, [&](const ContactPair& pair) {
    return *std::max_element(pair.vertices.begin(), pair.vertices.end()) < mesh_.num_gel_vertices;
  });
  return smallest_distance(pairs, x, none);
}

}  // namespace tacipc
