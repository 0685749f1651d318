#include "stages/press/solve/newton_step.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

#include "common/error.h"
#include "stages/press/solve/contact_assembly.h"

namespace tacipc {
namespace {

constexpr int kLocalTries = 8;        // to find the places about which a Hessian is not positive definite
constexpr double kSameShift = 1e-10;  // relative: the object's vertices are moved from rounded place to rounded place

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
  const Stopwatch watch(times_.linear_s);
  ++times_.solves;
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

SolverTimes NewtonStepper::times() const {
  SolverTimes times = times_;
  times.products = solver_->num_products();
  return times;
}

bool NewtonStepper::assemble_packs(const WeightedTerm& part, const Positions& x) {
  if (const auto* linear = dynamic_cast<const Elasticity*>(part.term.get()); linear && linear->packs()) {
    elastic_.add(*linear->packs(), x, {}, part.weight, free_, system_);
    return true;
  }
  if (const auto* averaged = dynamic_cast<const AveragedElasticity*>(part.term.get()); averaged && averaged->packs()) {
    const auto volume = averaged->volume_derivatives(x);
    elastic_.add(*averaged->packs(), x, volume.pressure, part.weight, free_, system_);
    volume_.add(*averaged, volume.second, x, part.weight, free_, system_);
    return true;
  }
  return false;
}

void NewtonStepper::assemble_all(const IncrementalPotential& potential, const Positions& x, Order elastic,
                                 const Blend& blend, const ObjectMotion& object) {
  timed(times_.elastic_s, [&] {
    clear(system_, free_, pattern_);
    for (const WeightedTerm& part : potential.terms) {
      if (part.contact) continue;
      if (elastic == Order::hessian && assemble_packs(part, x)) continue;
      assemble(part, x, free_, first_object_vertex_, elastic, object.of_vertices, system_);
    }
  });
  const Stopwatch watch(times_.contact_s);
  auto active = active_.begin();
  const Vector3 without = gel_gradient();
  Vector3 so_far = without, last = Vector3::Zero();
  for (const WeightedTerm& part : potential.terms) {
    if (!part.contact) continue;
    assemble_contact(part.weight, *part.contact, *active++, x, free_, first_object_vertex_, blend, object, system_);
    last = gel_gradient() - so_far;
    so_far += last;
  }
  contact_sum_ = std::min(last.norm(), (so_far - without).norm());
}

/// Σ of the system's gradient over the gel's free vertices.
Vector3 NewtonStepper::gel_gradient() const {
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < free_.size(); ++i) {
    if (free_.vertex_of_free[i] < first_object_vertex_) sum += system_.gradient.segment<3>(3 * i);
  }
  return sum;
}

void NewtonStepper::reblend(const IncrementalPotential& potential, const Positions& x, const Blend& before,
                            const Blend& after, const ObjectMotion& object) {
  const Stopwatch watch(times_.contact_s);
  auto active = active_.begin();
  for (const WeightedTerm& part : potential.terms) {
    if (part.contact)
      reblend_contact(part.weight, *part.contact, *active++, x, free_, first_object_vertex_, before, after, object,
                      system_);
  }
}

std::vector<int> NewtonStepper::solve_or_blame(const std::vector<int>& yielding, const Positions& motion,
                                               double longest_m, NewtonDirection& out) {
  std::vector<int> wrong;
  if (solve(system_, yielding, motion, out)) {
    for (const int v : free_.vertex_of_free) {
      if (out.p.row(v).squaredNorm() > longest_m * longest_m) wrong.push_back(v);
    }
    return wrong;
  }
  for (const int i : solver_->indefinite_rows()) wrong.push_back(free_.vertex_of_free[i]);
  return wrong.empty() ? free_.vertex_of_free : wrong;
}

NewtonDirection NewtonStepper::direction(const IncrementalPotential& potential, const Positions& x,
                                         const Positions& motion, const std::vector<int>& yielding, double longest_m,
                                         Blend& blend) {
  active_.clear();
  for (const WeightedTerm& part : potential.terms) {
    if (!part.contact) continue;
    const Stopwatch watch(times_.contact_s);
    active_.push_back(part.contact->active(x));
    pattern_ = cover_contacts(pattern_, free_, first_object_vertex_, *part.contact, active_.back(), x);
  }
  const auto of_object = motion.bottomRows(motion.rows() - first_object_vertex_);
  const Vector3 shift = of_object.rows() > 0 ? Vector3(of_object.row(0)) : Vector3::Zero();
  const bool rigid_shift = of_object.rows() == 0 || (of_object.rowwise() - shift.transpose()).cwiseAbs().maxCoeff() <=
                                                        kSameShift * shift.cwiseAbs().maxCoeff();
  const bool in_full = !yielding.empty() || !rigid_shift;
  const ObjectMotion object{motion, in_full, in_full ? Vector3::Zero() : shift};

  const auto lean_more = [&](const std::vector<int>& vertices) {
    bool more = false;
    for (const int v : vertices) {
      if (v < first_object_vertex_) more = blend.failed(v) || more;
    }
    return more;
  };
  NewtonDirection out;
  assemble_all(potential, x, Order::hessian, blend, object);
  bool projected = false;
  for (int tries = 1;; ++tries) {
    constexpr double kAnyLength = std::numeric_limits<double>::infinity();
    const std::vector<int> wrong = solve_or_blame(yielding, motion, projected ? kAnyLength : longest_m, out);
    if (wrong.empty()) break;
    const Blend before = blend;
    if ((tries <= kLocalTries && lean_more(wrong)) || lean_more(free_.vertex_of_free)) {
      reblend(potential, x, before, blend, object);
    } else if (!projected) {
      projected = true;
      assemble_all(potential, x, Order::psd, blend, object);
    } else {
      throw SolverError("the projected Hessian is not positive definite");
    }
  }
  out.blend = blend.largest();
  out.gradient_sum = sum_of_norms(system_.gradient);
  out.contact_sum = contact_sum_;
  for (const int axis : yielding) out.gradient_sum += std::abs(system_.object_gradient[axis]);
  blend.found();
  return out;
}

}  // namespace tacipc
