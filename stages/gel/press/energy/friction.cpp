#include "stages/gel/press/energy/friction.h"

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

Friction::Friction(const ContactBarrier& barrier, const std::vector<int>& active, const Positions& lagged,
                   const Positions& start, double epsilon_m)
    : epsilon_m_(epsilon_m) {
  pairs_.reserve(active.size());
  for (const int i : active) {
    const ContactPair& contact = barrier.pairs()[i];
    const ContactBarrier::Push push = barrier.push(i, gather(lagged, contact));
    const double normal_force = push.force * barrier.laws().relative_friction(barrier.law(i));
    if (normal_force == 0.0) continue;
    Pair pair;
    pair.vertices = contact.vertices;
    pair.weights = push.feature.weights;
    pair.normal_force = normal_force;
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

double Friction::value_of(const std::vector<int>& active, const Positions& x) const {
  return ordered_sum(static_cast<int>(active.size()), [&](int first, int last) {
    double sum = 0.0;
    for (int k = first; k < last; ++k) {
      const int i = active[static_cast<std::size_t>(k)];
      sum += pairs_[i].normal_force * friction_integral(relative_slide(i, x) * epsilon_m_, epsilon_m_);
    }
    return sum;
  });
}

// Exact: ∂²f₀(‖u‖)/∂u² = (f₁/y) I + (f₁′ − f₁/y) û ûᵀ with f₁′ = 2 (1 − y/ε)/ε ≥ 0, never negative. A step along û with
// it overshoots between sticking and slipping, because it does not show how soon f₁ changes. f₀(√s) is concave in s, so
// the quadratic of (f₁/y) I alone lies above the energy everywhere. It is the PSD approximation, with which full steps
// decrease the energy. A pair of negative weight has no PSD approximation.
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

namespace {

/// Data of eight pairs, one per lane.
struct PackedFriction {
  Pack weights[4];
  Pack3 tangents[2], start;
  Pack normal_force;
};

/// evaluate_blended() lane by lane.
TACIPC_CLONES void evaluate_lanes(const double* x, const std::array<std::array<int, kLanes>, 4>& vertices,
                                  const PackedFriction& pair, double epsilon, const Pack& blend, WantedVertices wanted,
                                  PackedBlocks& out) {
  const Pack none = {}, one = none + 1.0;
  Pack3 moved = Pack3{} - pair.start;
  for (int k = 0; k < 4; ++k) moved = moved + pair.weights[k] * load_rows(x, vertices[k]);
  const Pack u0 = dot(pair.tangents[0], moved), u1 = dot(pair.tangents[1], moved), squared = u0 * u0 + u1 * u1;
  Pack y;
  for (int l = 0; l < kLanes; ++l) y[l] = std::sqrt(squared[l]);
  const Pack r = y / epsilon;
  const Pack sticks = one - r;
  const Pack part_over_y = choose(sticks, (2.0 - r) / epsilon, one / y);
  const Pack slope = choose(sticks, 2.0 * sticks / epsilon, none);
  const Pack majorant = part_over_y * choose(pair.normal_force, one, one - blend);
  const Pack outer = choose(squared, (1.0 - blend) * (slope - part_over_y) / squared, none);
  const Pack inner00 = pair.normal_force * (majorant + outer * u0 * u0), inner01 = pair.normal_force * outer * u0 * u1,
             inner11 = pair.normal_force * (majorant + outer * u1 * u1);
  const Pack3 &t0 = pair.tangents[0], &t1 = pair.tangents[1];
  const Pack3 force = (pair.normal_force * part_over_y) * (u0 * t0 + u1 * t1);
  // T inner Tᵀ by columns.
  const Pack3 i0 = inner00 * t0 + inner01 * t1, i1 = inner01 * t0 + inner11 * t1;
  const Pack3 columns[3] = {t0.x * i0 + t1.x * i1, t0.y * i0 + t1.y * i1, t0.z * i0 + t1.z * i1};
  for (int b = 0; b < wanted.count; ++b) {
    const Pack wb = pair.weights[wanted.first + b];
    const Pack3 g = wb * force;
    out.gradient[b][0] = g.x;
    out.gradient[b][1] = g.y;
    out.gradient[b][2] = g.z;
    for (int a = b; a < wanted.count; ++a) {
      const Pack ww = pair.weights[wanted.first + a] * wb;
      Pack* block = out.blocks[block_index(a, b)];
      for (int c = 0; c < 3; ++c) {
        block[3 * c] = ww * columns[c].x;
        block[3 * c + 1] = ww * columns[c].y;
        block[3 * c + 2] = ww * columns[c].z;
      }
    }
  }
}

}  // namespace

void Friction::evaluate_pack(const StencilPack& which, int /*count*/, const Positions& x, const Pack& blend,
                             WantedVertices wanted, PackedBlocks& out) const {
  PackedFriction packed = {};
  std::array<std::array<int, kLanes>, 4> vertices;
  for (int l = 0; l < kLanes; ++l) {
    const Pair& pair = pairs_[which[l]];
    for (int k = 0; k < 4; ++k) {
      vertices[k][l] = pair.vertices[k];
      packed.weights[k][l] = pair.weights[k];
    }
    const auto put = [l](const Vector3& from, Pack3& to) {
      to.x[l] = from.x();
      to.y[l] = from.y();
      to.z[l] = from.z();
    };
    put(pair.tangents.col(0), packed.tangents[0]);
    put(pair.tangents.col(1), packed.tangents[1]);
    put(pair.start, packed.start);
    packed.normal_force[l] = pair.normal_force;
  }
  evaluate_lanes(x.data(), vertices, packed, epsilon_m_, blend, wanted, out);
}

}  // namespace tacipc
