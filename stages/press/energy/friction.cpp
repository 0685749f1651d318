#include "stages/press/energy/friction.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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
  for (const int i : barrier.active(lagged)) {
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

std::shared_ptr<const Friction> Friction::restricted_to(const std::vector<bool>& moves) const {
  auto some = std::make_shared<Friction>(*this);
  std::erase_if(some->pairs_, [&](const Pair& pair) {
    return std::none_of(pair.vertices.begin(), pair.vertices.end(), [&](int v) { return moves[v]; });
  });
  return some;
}

Eigen::Vector2d Friction::slide(const Pair& pair, const FourPoints& x) {
  Vector3 now = Vector3::Zero();
  for (int k = 0; k < 4; ++k) now += pair.weights[k] * x[k];
  return pair.tangents.transpose() * (now - pair.start);
}

double Friction::relative_slide(int i, const Positions& x) const {
  const auto& v = pairs_[i].vertices;
  return slide(pairs_[i], {x.row(v[0]), x.row(v[1]), x.row(v[2]), x.row(v[3])}).norm() / epsilon_m_;
}

std::vector<int> Friction::active(const Positions&) const {
  std::vector<int> all(pairs_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

double Friction::value(const Positions& x) const {
  return ordered_sum(num_stencils(), [&](int first, int last) {
    double sum = 0.0;
    for (int i = first; i < last; ++i)
      sum += pairs_[i].normal_force * friction_integral(relative_slide(i, x) * epsilon_m_, epsilon_m_);
    return sum;
  });
}

// ∂²f₀(‖u‖)/∂u² = (f₁/y) I + (f₁′ − f₁/y) û ûᵀ with f₁′ = 2 (1 − y/ε)/ε ≥ 0: never negative. It says nothing of how
// soon f₁ changes, though, and a step along û overshoots between sticking and slipping. As f₀(√s) is concave in s,
// (f₁/y) I alone lies above the energy everywhere: that is the stand-in, with which full steps go down. Of a pair that
// counts against the others nothing does.
Eigen::Matrix2d Friction::blended_inner(const Pair& pair, const Eigen::Vector2d& u, double blend) const {
  const double y = u.norm(), r = y / epsilon_m_;
  // f₁(y)/y, finite at y = 0.
  const double part_over_y = r < 1.0 ? (2.0 - r) / epsilon_m_ : 1.0 / y;
  Eigen::Matrix2d inner = part_over_y * Eigen::Matrix2d::Identity();
  if (pair.normal_force < 0.0) inner *= 1.0 - blend;
  if (y > 0.0 && blend < 1.0) {
    const double slope = r < 1.0 ? 2.0 * (1.0 - r) / epsilon_m_ : 0.0;
    inner += (1.0 - blend) * (slope - part_over_y) / (y * y) * u * u.transpose();
  }
  return inner;
}

Vector3 Friction::force(const Pair& pair, const Eigen::Vector2d& u) const {
  const double y = u.norm(), r = y / epsilon_m_;
  return pair.normal_force * (r < 1.0 ? (2.0 - r) / epsilon_m_ : 1.0 / y) * (pair.tangents * u);
}

bool Friction::evaluate_gradient(int i, const FourPoints& x, Vector12& out) const {
  const Pair& pair = pairs_[i];
  const Vector3 whole = force(pair, slide(pair, x));
  for (int a = 0; a < 4; ++a) out.segment<3>(3 * a) = pair.weights[a] * whole;
  return true;
}

bool Friction::evaluate_blended(int i, const FourPoints& x, double blend, PairVertices wanted, PairLocal& out) const {
  const Pair& pair = pairs_[i];
  const Eigen::Vector2d u = slide(pair, x);
  const Vector3 whole = force(pair, u);
  const Matrix3 block = pair.normal_force * pair.tangents * blended_inner(pair, u, blend) * pair.tangents.transpose();
  for (int a = 0; a < 4; ++a) {
    if (!(wanted >> a & 1U)) continue;
    out.gradient.segment<3>(3 * a) = pair.weights[a] * whole;
    for (int b = 0; b < 4; ++b) {
      if (wanted >> b & 1U) out.hessian.block<3, 3>(3 * a, 3 * b) = pair.weights[a] * pair.weights[b] * block;
    }
  }
  return true;
}

void Friction::evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const {
  const FourPoints points{x.segment<3>(0), x.segment<3>(3), x.segment<3>(6), x.segment<3>(9)};
  out.zero = false;
  out.value = pairs_[i].normal_force * friction_integral(slide(pairs_[i], points).norm(), epsilon_m_);
  if (order == Order::value) return;
  PairLocal local;
  evaluate_blended(i, points, order == Order::psd ? 1.0 : 0.0, kAllPairVertices, local);
  out.fit(4, order);
  out.gradient = local.gradient;
  if (order >= Order::hessian) out.hessian = local.hessian;
}

}  // namespace tacipc
