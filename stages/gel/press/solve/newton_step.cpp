#include "stages/gel/press/solve/newton_step.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "common/base/error.h"
#include "stages/gel/press/energy/joined_term.h"
#include "stages/gel/press/solve/contact_assembly.h"

namespace tacipc {
namespace {

// Number of solves after which shares are raised only locally. Afterwards they are raised at all vertices if the system
// is not positive definite, and nowhere if a step is merely long.
constexpr int kMaxLocalRaises = 8;
// A vertex's diagonal block is its stiffness with all others fixed, much larger than with compliant neighbours. If the
// block is not positive definite without this fraction of the gel's own stiffness, the matrix is probably not positive
// definite there.
constexpr double kHeldByOthers = 0.8;
constexpr double kFullSolve = 1e-10;  // tolerance of a linear system whose coarser solution ascends
// Elements keep the Hessian with which they were last assembled until they have changed by this (ElasticPacks::change).
constexpr double kKeptHessian = 0.1;
// Relative tolerance, because the object's vertices move from rounded positions to rounded positions.
constexpr double kSameTranslation = 1e-10;

/// Smallest nonzero contact sum of gels; if no gel is touched, of free bodies.
double least_touch(const std::vector<double>& touches, int gels, const std::vector<bool>& without_mount) {
  // Two fingers on a soft body cancel in its sum, so gels on mounts come first, then bodies without a mount, and free
  // bodies last.
  const auto rank = [&](int i) {
    return i >= gels ? 2 : !without_mount.empty() && without_mount[static_cast<std::size_t>(i)] ? 1 : 0;
  };
  for (int wanted = 0; wanted <= 2; ++wanted) {
    double least = 0.0;
    for (int i = 0; i < static_cast<int>(touches.size()); ++i) {
      const double touch = touches[static_cast<std::size_t>(i)];
      if (rank(i) == wanted && touch > 0.0 && (least == 0.0 || touch < least)) least = touch;
    }
    if (least > 0.0) return least;
  }
  return 0.0;
}

}  // namespace

NewtonStepper::NewtonStepper(FreeVertices free, int first_object_vertex, std::shared_ptr<const EnergyTerm> elasticity,
                             LinearSolverKind solver)
    : free_(std::move(free)),
      first_object_vertex_(first_object_vertex),
      elasticity_(std::move(elasticity)),
      own_pattern_(mesh_pattern(free_, *elasticity_)),
      pattern_(own_pattern_),
      changed_(static_cast<std::size_t>(free_.size()), 1),
      solver_(make_linear_solver(solver)) {
  for (const auto& part : parts_of(elasticity_)) {
    const EnergyTerm* term = part.get();
    if (const auto* linear = dynamic_cast<const Elasticity*>(term); linear && linear->packs())
      packed_.push_back({term, ElasticAssembly(*linear->packs(), free_)});
    if (const auto* averaged = dynamic_cast<const AveragedElasticity*>(term); averaged && averaged->packs())
      packed_.push_back({term, ElasticAssembly(*averaged->packs(), free_), averaged, VolumeAssembly(*averaged, free_)});
  }
}

SolverTimes NewtonStepper::times() const {
  SolverTimes times = times_;
  times.products = solver_->num_products();
  times.factorised = solver_->num_factorized();
  return times;
}

NewtonStepper::Call NewtonStepper::start(const NewtonProblem& problem) {
  const auto active = [&](const WeightedContact& contact, const std::vector<int>* known) -> std::vector<int> {
    if (!contact.term) return {};
    const Stopwatch watch(times_.contact_s);
    std::vector<int> found = known ? *known : contact.term->active(problem.x);
    pattern_ = cover_contacts(pattern_, free_, first_object_vertex_, *contact.term, found, problem.x);
    return found;
  };
  std::vector<int> friction = active(problem.potential.friction, nullptr),
                   barrier = active(problem.potential.barrier, problem.active_barrier);

  const auto of_object = problem.motion.middleRows(first_object_vertex_, num_object_rows(problem.motion));
  const Vector3 translation = of_object.rows() > 0 ? Vector3(of_object.row(0)) : Vector3::Zero();
  const bool translates =
      of_object.rows() == 0 || (of_object.rowwise() - translation.transpose()).cwiseAbs().maxCoeff() <=
                                   kSameTranslation * translation.cwiseAbs().maxCoeff();
  const bool in_full = !problem.free_axes.empty() || !translates;
  return {problem,
          {problem.motion, in_full, in_full ? Vector3::Zero() : translation},
          std::move(friction),
          std::move(barrier)};
}

void NewtonStepper::PackedPart::add(double weight, const Positions& x, NewtonSystem& system) {
  if (!averaged) return packs.add(x, {}, weight, system);
  const auto volume = averaged->volume_derivatives(x);
  packs.add(x, volume.pressure, weight, system);
  volumes->add(volume.second, x, weight, system);
}

void NewtonStepper::PackedPart::update(const Positions& x, NewtonSystem& system, std::vector<char>& changed_rows) {
  if (!averaged) return packs.update(x, {}, kKeptHessian, system, changed_rows);
  const auto volume = averaged->volume_derivatives(x);
  packs.update(x, volume.pressure, kKeptHessian, system, changed_rows);
  volumes->update(volume.second, x, packs, system, changed_rows);
}

NewtonStepper::PackedPart* NewtonStepper::packed(const EnergyTerm* term) {
  const auto found =
      std::find_if(packed_.begin(), packed_.end(), [&](const PackedPart& part) { return part.term == term; });
  return found == packed_.end() ? nullptr : &*found;
}

bool NewtonStepper::update_packs(const Call& call) {
  const std::vector<WeightedTerm>& terms = call.problem.potential.terms;
  const auto same = [](const WeightedTerm& a, const WeightedTerm& b) {
    return a.term == b.term && a.weight == b.weight;
  };
  if (system_.hessian.pattern != pattern_ || !std::equal(terms.begin(), terms.end(), held_.begin(), held_.end(), same))
    return false;
  const Positions& x = call.problem.x;
  clear_gradient(system_, free_);
  mark_held();
  const double* from = held_values_.data();
  for (const int c : held_columns_) {
    const std::size_t first = BlockMatrix::kStride * static_cast<std::size_t>(pattern_->column_start[c]),
                      last = BlockMatrix::kStride * static_cast<std::size_t>(pattern_->column_start[c + 1]);
    std::copy(from, from + (last - first), &system_.hessian.values[first]);
    from += last - first;
  }
  for (const WeightedTerm& part : terms) {
    if (PackedPart* elastic = packed(part.term.get())) {
      elastic->update(x, system_, changed_);
    } else {
      add_gradient(part, x, free_, system_);
    }
  }
  return true;
}

void NewtonStepper::hold_columns(const Call& call) {
  std::vector<bool> touched(static_cast<std::size_t>(free_.size()), false);
  for (const CarriedBody& body : free_.carried) {
    for (int k = 0; k < 4; ++k) touched[free_.free_of_vertex[body.first_control_point + k]] = true;
  }
  carried_alone_.clear();
  call.for_each_contact([&](const WeightedContact& contact, const std::vector<int>& active) {
    for (const int i : active) {
      bool alone = true;
      const std::span<const int> stencil = contact.term->stencil(i);
      for (const int v : stencil) {
        alone = alone && v >= first_object_vertex_;
        if (const int c = free_.free_of_vertex[v]; c >= 0) touched[c] = true;
      }
      if (alone) carried_alone_.insert(carried_alone_.end(), stencil.begin(), stencil.end());
    }
  });
  std::sort(carried_alone_.begin(), carried_alone_.end());
  carried_alone_.erase(std::unique(carried_alone_.begin(), carried_alone_.end()), carried_alone_.end());
  held_columns_.clear();
  held_values_.clear();
  for (int c = 0; c < free_.size(); ++c) {
    if (!touched[c]) continue;
    held_columns_.push_back(c);
    const auto first = static_cast<std::ptrdiff_t>(BlockMatrix::kStride) * pattern_->column_start[c],
               last = static_cast<std::ptrdiff_t>(BlockMatrix::kStride) * pattern_->column_start[c + 1];
    held_values_.insert(held_values_.end(), system_.hessian.values.begin() + first,
                        system_.hessian.values.begin() + last);
  }
}

void NewtonStepper::mark_held() {
  for (const int c : held_columns_) changed_[static_cast<std::size_t>(c)] = 1;
}

std::vector<double> NewtonStepper::assemble_all(const Call& call, Order elastic, const Blend& blend) {
  const Positions& x = call.problem.x;
  const std::vector<WeightedTerm>& terms = call.problem.potential.terms;
  // Gels that move with their mounts do not strain: of the Hessian times that motion only inertia and contact remain.
  const Eigen::VectorXd along = free_motion(call.problem);
  const bool mounts_move = along.size() > 0;
  const Positions still = mounts_move ? Positions(Positions::Zero(x.rows(), 3)) : Positions();
  timed(times_.elastic_s, [&] {
    if (elastic == Order::hessian && update_packs(call)) return;
    held_.clear();
    std::fill(changed_.begin(), changed_.end(), 1);
    clear(system_, free_, pattern_);
    bool all_kept = elastic == Order::hessian;
    for (const WeightedTerm& part : terms) {
      if (PackedPart* of_packs = elastic == Order::hessian ? packed(part.term.get()) : nullptr) {
        of_packs->add(part.weight, x, system_);
        continue;
      }
      assemble(part, x, free_, first_object_vertex_, elastic, mounts_move ? still : call.object.of_vertices, system_);
      all_kept = all_kept && has_constant_hessian(part, first_object_vertex_);
    }
    if (all_kept) held_ = terms;
  });
  timed(times_.contact_s, [&] { hold_columns(call); });
  mark_held();
  const Stopwatch watch(times_.contact_s);
  for (const WeightedTerm& part : call.problem.potential.of_bodies)
    assemble(part, x, free_, first_object_vertex_, Order::psd, call.object.of_vertices, system_);
  if (mounts_move) system_.coupling -= system_.hessian.multiply(along);
  const Eigen::Matrix3Xd without_contact = gradient_sums();
  const Eigen::VectorXd gradient_before = free_.gel_without_mount.empty() ? Eigen::VectorXd() : system_.gradient;
  Eigen::Matrix3Xd so_far = without_contact, of_barrier = 0.0 * without_contact;
  call.for_each_contact([&](const WeightedContact& contact, const std::vector<int>& active) {
    assemble_contact(contact.weight, *contact.term, active, x, free_, first_object_vertex_, blend, call.object,
                     system_);
    const Eigen::Matrix3Xd of_term = gradient_sums() - so_far;
    so_far += of_term;
    if (&contact == &call.problem.potential.barrier) of_barrier = of_term;
  });
  if (mounts_move) {
    system_.coupling += system_.hessian.multiply(along);
    for (const WeightedTerm& part : terms)
      add_inertia_coupling(part, first_object_vertex_, call.problem.motion, free_, system_);
  }
  std::vector<double> touches;
  for (Eigen::Index i = 0; i < so_far.cols(); ++i)
    touches.push_back(std::min(of_barrier.col(i).norm(), (so_far - without_contact).col(i).norm()));
  measure_squeezed(gradient_before, touches);
  return touches;
}

Eigen::VectorXd NewtonStepper::free_motion(const NewtonProblem& problem) const {
  Eigen::VectorXd motion(3 * static_cast<Eigen::Index>(free_.size()));
  for (int i = 0; i < free_.size(); ++i) motion.segment<3>(3 * i) = problem.motion.row(free_.vertex_of_free[i]);
  return motion.isZero(0.0) ? Eigen::VectorXd() : motion;
}

void NewtonStepper::reblend(const Call& call, const Blend& before, const Blend& after) {
  const Stopwatch watch(times_.contact_s);
  const Eigen::VectorXd along = free_motion(call.problem);
  if (along.size() > 0) system_.coupling -= system_.hessian.multiply(along);
  call.for_each_contact([&](const WeightedContact& contact, const std::vector<int>& active) {
    reblend_contact(contact.weight, *contact.term, active, call.problem.x, free_, first_object_vertex_, before, after,
                    call.object, system_, changed_);
  });
  if (along.size() > 0) system_.coupling += system_.hessian.multiply(along);
}

Eigen::Matrix3Xd NewtonStepper::gradient_sums() const {
  const std::vector<int>& gels = free_.gel_of_vertex;
  Eigen::Matrix3Xd sums = Eigen::Matrix3Xd::Zero(3, num_gels() + static_cast<Eigen::Index>(free_.carried.size()));
  const int first_point = free_.size() - BlockPattern::kBodyRows * static_cast<int>(free_.carried.size());
  for (int i = 0; i < free_.size(); ++i) {
    const int v = free_.vertex_of_free[i];
    const auto gradient = system_.gradient.segment<3>(3 * i);
    if (i >= first_point) {
      sums.col(num_gels() + (i - first_point) / BlockPattern::kBodyRows) += gradient;
    } else if (v < first_object_vertex_) {
      sums.col(gels.empty() ? 0 : gels[static_cast<std::size_t>(v)]) += gradient;
    }
  }
  return sums;
}

bool NewtonStepper::solve(const NewtonProblem& problem, NewtonDirection& out) {
  const Stopwatch watch(times_.linear_s);
  const bool driven = !system_.coupling.isZero(0.0) || !system_.object_coupling.isZero(0.0);
  const auto found = [&] { return solve_once(problem, out) && (driven || out.slope <= 0.0); };
  if (found()) return true;
  if (problem.free_axes.empty()) return false;
  // With columns solved to a hundredth, the Schur complement may be indefinite, and its solution may ascend.
  solver_->set_tolerance(kFullSolve);
  const bool solved = found();
  solver_->set_tolerance(tolerance_);
  return solved;
}

/// Solves [H B; Bᵀ C] [p; q] = [−g − c; −g_q − c_q] for the free vertices and the object's free axes.
bool NewtonStepper::solve_once(const NewtonProblem& problem, NewtonDirection& out) {
  ++times_.solves;
  const bool prepared = solver_->prepare(system_.hessian, &changed_);
  std::fill(changed_.begin(), changed_.end(), 0);
  if (!prepared) return false;
  const auto solved = solver_->solve(-system_.gradient - system_.coupling);
  if (!solved) return false;
  Eigen::VectorXd step = *solved;
  out.object_shift.setZero();
  out.slope = 0.0;
  const std::vector<int>& axes = problem.free_axes;
  if (const auto k = static_cast<Eigen::Index>(axes.size()); k > 0) {
    Eigen::MatrixXd Z(step.size(), k), B(step.size(), k), C(k, k);
    Eigen::VectorXd rhs(k), gradient(k);
    for (Eigen::Index a = 0; a < k; ++a) {
      B.col(a) = system_.object_border.col(axes[a]);
      const auto column = solver_->solve(B.col(a));
      if (!column) return false;
      Z.col(a) = *column;
      gradient[a] = system_.object_gradient[axes[a]];
      rhs[a] = -gradient[a] - system_.object_coupling[axes[a]];
      for (Eigen::Index b = 0; b < k; ++b) C(a, b) = system_.object_hessian(axes[a], axes[b]);
    }
    const Eigen::MatrixXd schur = C - B.transpose() * Z;
    const Eigen::LLT<Eigen::MatrixXd> factor(0.5 * (schur + schur.transpose()));
    if (factor.info() != Eigen::Success) return false;
    const Eigen::VectorXd q = factor.solve(rhs - B.transpose() * step);
    step -= Z * q;
    for (Eigen::Index a = 0; a < k; ++a) out.object_shift[axes[a]] = q[a];
    out.slope = gradient.dot(q);
  }
  out.slope += system_.gradient.dot(step);
  out.p = problem.motion;
  for (int i = 0; i < free_.size(); ++i) out.p.row(free_.vertex_of_free[i]) += step.segment<3>(3 * i).transpose();
  if (!axes.empty())
    out.p.middleRows(first_object_vertex_, num_object_rows(out.p)).rowwise() += out.object_shift.transpose();
  for (const CarriedBody& body : free_.carried) body.carry(out.p);
  return true;
}

std::vector<int> NewtonStepper::indefinite_vertices() const {
  std::vector<int> found;
  for (const int i : solver_->indefinite_rows()) found.push_back(free_.vertex_of_free[i]);
  if (found.empty()) {
    found = free_.vertex_of_free;
    found.insert(found.end(), carried_alone_.begin(), carried_alone_.end());
    return found;
  }
  // A body has no contact Hessian of its own: shares are raised for all contacts.
  const bool body = std::any_of(found.begin(), found.end(), [&](int v) { return v >= first_object_vertex_; });
  if (body) found.insert(found.end(), carried_alone_.begin(), carried_alone_.end());
  const double* held = held_values_.data();
  for (const int c : held_columns_) {
    if (body) {
      found.push_back(free_.vertex_of_free[c]);
      continue;
    }
    const int first = pattern_->column_start[c];
    const Matrix3 left = system_.hessian.block(first) - kHeldByOthers * BlockMatrix::ConstBlock(held);
    if (Eigen::LLT<Matrix3>(left).info() != Eigen::Success) found.push_back(free_.vertex_of_free[c]);
    held += BlockMatrix::kStride * static_cast<std::size_t>(pattern_->column_start[c + 1] - first);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<int> NewtonStepper::too_long(const NewtonDirection& direction, double longest_m) const {
  std::vector<int> found;
  for (const int c : held_columns_) {
    const int v = free_.vertex_of_free[c];
    if (direction.p.row(v).squaredNorm() > longest_m * longest_m) found.push_back(v);
  }
  return found;
}

void NewtonStepper::measure_bodies(const Positions& x, NewtonDirection& out) const {
  out.bodies.clear();
  for (const CarriedBody& body : free_.carried) {
    const auto points = x.middleRows<4>(body.first_control_point);
    const Eigen::RowVector3d center = points.colwise().mean();
    Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
    for (int k = 0; k < 4; ++k) {
      const Vector3 on_point = system_.gradient.segment<3>(3 * (free_.free_of_vertex[body.first_control_point] + k));
      force += on_point;
      torque += Vector3(points.row(k) - center).cross(on_point);
    }
    out.bodies.push_back({force.norm(), torque.norm()});
  }
}

void NewtonStepper::measure_squeezed(const Eigen::VectorXd& gradient_before, std::vector<double>& touches) const {
  const std::vector<bool>& soft = free_.gel_without_mount;
  if (std::none_of(soft.begin(), soft.end(), [](bool is) { return is; })) return;
  std::vector<double> sums(soft.size(), 0.0);
  const int points = BlockPattern::kBodyRows * static_cast<int>(free_.carried.size());
  for (int i = 0; i < free_.size() - points; ++i) {
    const auto gel = static_cast<std::size_t>(free_.gel_of_vertex[static_cast<std::size_t>(free_.vertex_of_free[i])]);
    if (soft[gel]) sums[gel] += (system_.gradient - gradient_before).segment<3>(3 * i).norm();
  }
  for (std::size_t g = 0; g < soft.size(); ++g) {
    if (soft[g]) touches[g] = 0.5 * sums[g];
  }
}

void NewtonStepper::measure_gels(const std::vector<double>& touches, NewtonDirection& out) const {
  const std::vector<int>& gels = free_.gel_of_vertex;
  out.contact_sum = least_touch(touches, num_gels(), free_.gel_without_mount);
  out.gels.assign(static_cast<std::size_t>(num_gels()), {});
  // Control points of a body are held together by its stiffness; the residual of the body's balance is more meaningful.
  const int points = BlockPattern::kBodyRows * static_cast<int>(free_.carried.size());
  out.gradient_sum = 0.0;
  for (int i = 0; i < free_.size() - points; ++i) {
    const double norm = system_.gradient.segment<3>(3 * i).norm();
    out.gradient_sum += norm;
    const int v = free_.vertex_of_free[i];
    if (!gels.empty()) out.gels[static_cast<std::size_t>(gels[static_cast<std::size_t>(v)])].gradient_sum += norm;
  }
  for (std::size_t g = 0; g < out.gels.size(); ++g) {
    out.gels[g].contact_sum = touches[g];
  }
}

NewtonDirection NewtonStepper::direction(const NewtonProblem& problem, Blend& blend) {
  const Call call = start(problem);
  const auto raise_shares = [&](const std::vector<int>& vertices) {
    bool raised = false;
    for (const int v : vertices) {
      if (blend.has(v)) raised = blend.raise(v) || raised;
    }
    return raised;
  };
  NewtonDirection out;
  std::vector<double> touches = assemble_all(call, Order::hessian, blend);
  bool projected = false;
  Blend before = blend;
  for (int tries = 1;; ++tries) {
    before = blend;
    bool raised = false;
    if (solve(problem, out)) {
      // A vertex may make a long step if its share is 1.
      raised = !projected && tries <= kMaxLocalRaises && raise_shares(too_long(out, problem.longest_m));
      if (!raised) break;
    } else {
      raised = (tries <= kMaxLocalRaises && raise_shares(indefinite_vertices())) ||
               raise_shares(free_.vertex_of_free) || raise_shares(carried_alone_);
    }
    if (raised) {
      reblend(call, before, blend);
    } else if (!projected) {
      projected = true;
      touches = assemble_all(call, Order::psd, blend);
    } else {
      throw SolverError("the projected Hessian is not positive definite");
    }
  }
  measure_bodies(problem.x, out);
  out.largest_share = blend.largest();
  measure_gels(touches, out);
  for (const int axis : problem.free_axes) out.gradient_sum += std::abs(system_.object_gradient[axis]);
  blend.lower();
  return out;
}

}  // namespace tacipc
