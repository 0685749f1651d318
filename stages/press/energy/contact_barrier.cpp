#include "stages/press/energy/contact_barrier.h"

#include <algorithm>
#include <cmath>

#include "stages/press/contact/edge_edge_mollifier.h"
#include "stages/press/energy/barrier.h"

namespace tacipc {
namespace {

FourPoints unpack(const Eigen::VectorXd& x) {
  return {x.segment<3>(0), x.segment<3>(3), x.segment<3>(6), x.segment<3>(9)};
}

/// Positive semi-definite stand-in for ∂²b(s(x)) without eigenvalues. With r = Σ wᵢxᵢ, n = r/|r|, s = |r|²:
///   ∂²b = b″ ∇s∇sᵀ + b′ ∇²s,  ∇sᵢ = 2wᵢr,  ∇²s = 2[wwᵀ⊗I − B(AᵀA)⁻¹Bᵀ],  b′ < 0.
/// Along n it is [(4 s b″ + 2b′) wwᵀ + 2|b′| s W(AᵀA)⁻¹Wᵀ] ⊗ nnᵀ, both parts positive; only the indefinite coupling of
/// normal and tangential directions is left out.
void normal_hessian(const ClosestFeature& feature, double b1, double b2, Eigen::Map<Matrix12> out) {
  const double s = feature.squared_distance;
  const Vector3 n = feature.r / std::sqrt(s);
  const Eigen::Matrix4d C = (4.0 * s * b2 + 2.0 * b1) * feature.weights * feature.weights.transpose() -
                            2.0 * b1 * s * feature.W * inverse_gram(feature) * feature.W.transpose();
  const Matrix3 nn = n * n.transpose();
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) out.block<3, 3>(3 * i, 3 * j) = C(i, j) * nn;
  }
}

}  // namespace

ContactBarrier::ContactBarrier(const ContactMesh& mesh, std::vector<ContactPair> pairs, double d_hat_m)
    : pairs_(std::move(pairs)), s_hat_(pairs_.size(), d_hat_m * d_hat_m), mollifier_threshold_(pairs_.size(), 0.0) {
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const ContactPair& pair = pairs_[i];
    const FourPoints rest = gather(mesh.rest_positions, pair);
    if (*std::max_element(pair.vertices.begin(), pair.vertices.end()) < mesh.num_gel_vertices) {
      s_hat_[i] = std::min(s_hat_[i], 0.25 * closest_feature(pair, rest).squared_distance);
    }
    if (pair.kind == ContactPair::Kind::edge_edge) mollifier_threshold_[i] = edge_edge_mollifier_threshold(rest);
  }
}

ContactBarrier::Push ContactBarrier::push(int i, const FourPoints& points) const {
  Push out{closest_feature(pairs_[i], points), 0.0};
  const double s = out.feature.squared_distance;
  if (s >= s_hat_[i]) return out;
  out.force = -2.0 * pairs_[i].weight * std::sqrt(s) * barrier_d1(s, s_hat_[i]);
  if (const double c = edge_cross_squared_norm(points), threshold = mollifier_threshold_[i]; c < threshold)
    out.force *= edge_edge_mollifier(c, threshold);
  return out;
}

void ContactBarrier::evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const {
  const FourPoints points = unpack(x);
  const ClosestFeature feature = closest_feature(pairs_[i], points);
  const double s = feature.squared_distance, s_hat = s_hat_[i], weight = pairs_[i].weight;
  out.zero = s >= s_hat;
  out.value = 0.0;
  if (out.zero) return;
  out.value = weight * barrier(s, s_hat);
  if (!std::isfinite(out.value)) return;
  out.fit(4, order);

  const double threshold = mollifier_threshold_[i];
  const bool mollified = threshold > 0.0 && edge_cross_squared_norm(points) < threshold;
  const double b = out.value, b1 = weight * barrier_d1(s, s_hat), b2 = weight * barrier_d2(s, s_hat);
  if (!mollified) {
    if (order == Order::value) return;
    const Vector12 ds = squared_distance_gradient(feature);
    out.gradient = b1 * ds;
    if (order == Order::gradient) return;
    if (order == Order::psd && weight < 0.0) {
      out.hessian.setZero();  // without what it takes back, the others' stand-in is the stiffer one
    } else if (order == Order::psd) {
      normal_hessian(feature, b1, b2, Eigen::Map<Matrix12>(out.hessian.data()));
    } else {
      out.hessian = b2 * ds * ds.transpose() + b1 * squared_distance_hessian(feature);
    }
    return;
  }
  if (order == Order::value) {
    out.value = edge_edge_mollifier(edge_cross_squared_norm(points), threshold) * b;
    return;
  }
  const EdgeEdgeMollifier m = edge_edge_mollifier(points, threshold);
  const Vector12 ds = squared_distance_gradient(feature);
  out.value = m.value * b;
  out.gradient = m.value * b1 * ds + b * m.gradient;
  if (order == Order::gradient) return;
  // All four parts of the product's second derivative: without those of m, Newton crawls where edges run parallel.
  Matrix12 hessian = m.value * (b2 * ds * ds.transpose() + b1 * squared_distance_hessian(feature)) +
                     b1 * (ds * m.gradient.transpose() + m.gradient * ds.transpose()) + b * m.hessian;
  if (order == Order::psd) project_psd(hessian);
  out.hessian = hessian;
}

}  // namespace tacipc
