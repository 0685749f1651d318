#include "stages/press/solve/newton_step.h"

#include <Eigen/Cholesky>

#include "common/error.h"

namespace tacipc {
namespace {

// How the share of the contact Hessian's positive stand-in adapts: as small as positive definiteness lets it be.
constexpr double kFirstBlend = 0.02, kBlendGrowth = 3.0, kBlendShrink = 2.0;

/// Σᵢ |row i| of a vector of stacked triples.
double sum_of_norms(const Eigen::VectorXd& stacked) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < stacked.size(); i += 3) sum += stacked.segment<3>(i).norm();
  return sum;
}

}  // namespace

NewtonStepper::NewtonStepper(FreeVertices free, int first_object_vertex, std::shared_ptr<const BlockPattern> pattern,
                             LinearSolverKind solver)
    : free_(std::move(free)),
      first_object_vertex_(first_object_vertex),
      own_pattern_(std::move(pattern)),
      pattern_(own_pattern_),
      solver_(make_linear_solver(solver)) {}

/// Solves [H B; Bᵀ C] [p; q] = [−g − c; −g_q − c_q] for the free vertices and the object's yielding
/// axes; false if the matrix is not positive definite.
bool NewtonStepper::solve(const NewtonSystem& system, const std::vector<int>& yielding, const Positions& motion,
                          NewtonDirection& out) {
  if (!solver_->prepare(system.hessian)) return false;
  const auto solved = solver_->solve(-system.gradient - system.coupling);
  if (!solved) return false;
  Eigen::VectorXd step = *solved;
  out.yield.setZero();
  out.slope = 0.0;
  if (const auto k = static_cast<Eigen::Index>(yielding.size()); k > 0) {
    Eigen::MatrixXd Z(step.size(), k), B(step.size(), k), C(k, k);
    Eigen::VectorXd rhs(k), gradient(k);
    for (Eigen::Index a = 0; a < k; ++a) {
      B.col(a) = system.object_border.col(yielding[a]);
      const auto column = solver_->solve(B.col(a));
      if (!column) return false;
      Z.col(a) = *column;
      gradient[a] = system.object_gradient[yielding[a]];
      rhs[a] = -gradient[a] - system.object_coupling[yielding[a]];
      for (Eigen::Index b = 0; b < k; ++b) C(a, b) = system.object_hessian(yielding[a], yielding[b]);
    }
    const Eigen::MatrixXd schur = C - B.transpose() * Z;
    const Eigen::LLT<Eigen::MatrixXd> factor(0.5 * (schur + schur.transpose()));
    if (factor.info() != Eigen::Success) return false;
    const Eigen::VectorXd q = factor.solve(rhs - B.transpose() * step);
    step -= Z * q;
    for (Eigen::Index a = 0; a < k; ++a) out.yield[yielding[a]] = q[a];
    out.slope = gradient.dot(q);
  }
  out.slope += system.gradient.dot(step);
  out.p = motion;
  for (int i = 0; i < free_.size(); ++i) out.p.row(free_.vertex_of_free[i]) = step.segment<3>(3 * i).transpose();
  if (!yielding.empty()) out.p.bottomRows(out.p.rows() - first_object_vertex_).rowwise() += out.yield.transpose();
  return true;
}

NewtonDirection NewtonStepper::direction(const IncrementalPotential& potential, const Positions& x,
                                         const Positions& motion, const std::vector<int>& yielding, double& blend) {
  for (const WeightedTerm& part : potential.terms) {
    if (part.contact) pattern_ = cover_contacts(pattern_, free_, *part.term, x);
  }
  // Everything but contact and friction, elasticity as told.
  const auto body = [&](Order elastic) {
    NewtonSystem system = empty_system(free_, pattern_);
    for (const WeightedTerm& part : potential.terms) {
      if (!part.contact) assemble(part, x, free_, first_object_vertex_, elastic, motion, system);
    }
    return system;
  };
  const auto with_contact = [&](NewtonSystem system, Order order) {
    for (const WeightedTerm& part : potential.terms) {
      if (part.contact) assemble(part, x, free_, first_object_vertex_, order, motion, system);
    }
    return system;
  };
  NewtonDirection out;
  const auto finished = [&](const NewtonSystem& system, double used) {
    out.blend = used;
    out.gradient_sum = sum_of_norms(system.gradient);
    for (const int axis : yielding) out.gradient_sum += std::abs(system.object_gradient[axis]);
    return out;
  };
  const NewtonSystem elastic = body(Order::hessian);
  NewtonSystem positive = with_contact(elastic, Order::psd);
  if (blend < 1.0) {
    const NewtonSystem exact = with_contact(elastic, Order::hessian);
    NewtonSystem mixed = exact;
    const auto mix = [&](auto& target, const auto& from, const auto& to) { target = from + blend * (to - from); };
    for (; blend < 1.0; blend = blend == 0.0 ? kFirstBlend : kBlendGrowth * blend) {
      for (std::size_t k = 0; k < mixed.hessian.values.size(); ++k) {
        mixed.hessian.values[k] =
            exact.hessian.values[k] + blend * (positive.hessian.values[k] - exact.hessian.values[k]);
      }
      mix(mixed.coupling, exact.coupling, positive.coupling);
      mix(mixed.object_border, exact.object_border, positive.object_border);
      mix(mixed.object_hessian, exact.object_hessian, positive.object_hessian);
      mix(mixed.object_coupling, exact.object_coupling, positive.object_coupling);
      if (!solve(mixed, yielding, motion, out)) continue;
      const double used = blend;
      blend = blend > kFirstBlend ? blend / kBlendShrink : 0.0;
      return finished(mixed, used);
    }
    blend = 1.0;
  }
  const double used = blend;
  blend = 0.99 / kBlendShrink;
  if (solve(positive, yielding, motion, out)) return finished(positive, used);
  const NewtonSystem projected = with_contact(body(Order::psd), Order::psd);
  if (solve(projected, yielding, motion, out)) return finished(projected, used);
  throw SolverError("the projected Hessian is not positive definite");
}

}  // namespace tacipc
