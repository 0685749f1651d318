#include "stages/press/energy/friction.h"

#include <cmath>

namespace tacipc {

double friction_part(double y, double epsilon) {
  const double r = y / epsilon;
  return r < 1.0 ? r * (2.0 - r) : 1.0;
}

double friction_integral(double y, double epsilon) {
  const double r = y / epsilon;
  return r < 1.0 ? epsilon * (r * r * (1.0 - r / 3.0) + 1.0 / 3.0) : y;
}

Friction::Friction(const ContactBarrier& barrier, const Positions& lagged, const Positions& start, double epsilon_m)
    : epsilon_m_(epsilon_m) {
  for (int i = 0; i < barrier.num_stencils(); ++i) {
    const ContactPair& contact = barrier.pairs()[i];
    const ContactBarrier::Push push = barrier.push(i, gather(lagged, contact));
    if (push.force == 0.0) continue;
    Pair pair;
    pair.vertices = contact.vertices;
    pair.weights = push.feature.weights;
    pair.normal_force = push.force;
    const Vector3 n = push.feature.r.normalized();
    pair.tangents.col(0) = n.unitOrthogonal();
    pair.tangents.col(1) = n.cross(pair.tangents.col(0));
    pair.start.setZero();
    for (int k = 0; k < 4; ++k) pair.start += pair.weights[k] * start.row(pair.vertices[k]).transpose();
    pairs_.push_back(pair);
  }
}

std::shared_ptr<const Friction> Friction::mixed_with(const Friction& newer, double part) const {
  constexpr double kSmallestShare = 1e-3;
  auto mixed = std::make_shared<Friction>(*this);
  mixed->pairs_.clear();
  const auto take = [&](const Friction& from, double scale) {
    for (Pair pair : from.pairs_) {
      pair.share *= scale;
      pair.normal_force *= scale;
      if (pair.share >= kSmallestShare) mixed->pairs_.push_back(pair);
    }
  };
  take(*this, 1.0 - part);
  take(newer, part);
  return mixed;
}

double Friction::relative_slide(int i, const Positions& x) const {
  const Pair& pair = pairs_[i];
  Vector3 now = Vector3::Zero();
  for (int k = 0; k < 4; ++k) now += pair.weights[k] * x.row(pair.vertices[k]).transpose();
  return (pair.tangents.transpose() * (now - pair.start)).norm() / epsilon_m_;
}

void Friction::evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const {
  const Pair& pair = pairs_[i];
  Vector3 now = Vector3::Zero();
  for (int k = 0; k < 4; ++k) now += pair.weights[k] * x.segment<3>(3 * k);
  const Eigen::Vector2d u = pair.tangents.transpose() * (now - pair.start);
  const double y = u.norm(), lambda = pair.normal_force;
  out.zero = false;
  out.value = lambda * friction_integral(y, epsilon_m_);
  if (order == Order::value) return;
  // f₁(y)/y, finite at y = 0.
  const double r = y / epsilon_m_;
  const double part_over_y = r < 1.0 ? (2.0 - r) / epsilon_m_ : 1.0 / y;
  const Vector3 force = lambda * part_over_y * (pair.tangents * u);
  out.fit(4, order);
  for (int k = 0; k < 4; ++k) out.gradient.segment<3>(3 * k) = pair.weights[k] * force;
  if (order == Order::gradient) return;
  // ∂²f₀(‖u‖)/∂u² = (f₁/y) I + (f₁′ − f₁/y) û ûᵀ with f₁′ = 2 (1 − y/ε)/ε ≥ 0: never negative. It says nothing of how
  // soon f₁ changes, though, and a step along û overshoots between sticking and slipping. As f₀(√s) is concave in s,
  // (f₁/y) I alone lies above the energy everywhere: that is the stand-in, with which full steps go down. Of a pair
  // that counts against the others nothing does.
  if (order == Order::psd && lambda < 0.0) {
    out.hessian.setZero();
    return;
  }
  Eigen::Matrix2d inner = part_over_y * Eigen::Matrix2d::Identity();
  if (y > 0.0 && order != Order::psd) {
    const double slope = r < 1.0 ? 2.0 * (1.0 - r) / epsilon_m_ : 0.0;
    inner += (slope - part_over_y) / (y * y) * u * u.transpose();
  }
  const Matrix3 block = lambda * pair.tangents * inner * pair.tangents.transpose();
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < 4; ++b) out.hessian.block<3, 3>(3 * a, 3 * b) = pair.weights[a] * pair.weights[b] * block;
  }
}

}  // namespace tacipc
