#include "stages/gel/press/energy/contact_barrier.h"

#include <algorithm>
#include <cmath>

#include "stages/gel/press/contact/edge_edge_mollifier.h"
#include "stages/gel/press/contact/near_pairs.h"
#include "stages/gel/press/energy/barrier.h"

namespace tacipc {
namespace {

FourPoints four_points(const Eigen::VectorXd& x) {
  return {x.segment<3>(0), x.segment<3>(3), x.segment<3>(6), x.segment<3>(9)};
}

/// Computes (1 − blend) H + blend H₊ of b(s(x)), H₊ a PSD approximation, in blocks between wanted vertices. With r = Σ
/// wᵢxᵢ, n = r/|r|, s = |r|²:
///   H = b″ ∇s∇sᵀ + b′ ∇²s,  ∇sᵢ = 2wᵢr,  ∇²s = 2[wwᵀ⊗I − B(AᵀA)⁻¹Bᵀ],  B_iq = W_iq r + wᵢ A_q,  b′ < 0.
/// Along n, H is [(4 s b″ + 2b′) wwᵀ + 2|b′| s W(AᵀA)⁻¹Wᵀ] ⊗ nnᵀ. Both terms are positive, and together they are H₊,
/// which needs no eigenvalues. H₊ omits only the indefinite coupling of normal and tangential directions.
/// barrier_packs.cpp has the same computation for eight pairs at a time.
void blended_hessian(const ClosestFeature& f, double b1, double b2, double blend, PairVertices wanted, Matrix12& out) {
  const Eigen::Matrix2d gram = inverse_gram(f);
  const double s = f.squared_distance, exact = 1.0 - blend;
  const Matrix3 rr = f.r * f.r.transpose();
  const Eigen::Matrix4d ww = f.weights * f.weights.transpose(), WW = f.W * gram * f.W.transpose();
  // H₊ and H share all terms in nnᵀ except b″: C nnᵀ = (C/s) rrᵀ.
  const Eigen::Matrix4d along = (blend * (4.0 * b2 + 2.0 * b1 / s) + exact * 4.0 * b2) * ww - 2.0 * b1 * WW;
  for (int j = 0; j < 4; ++j) {
    if (!(wanted >> j & 1U)) continue;
    for (int i = j; i < 4; ++i) {
      if (!(wanted >> i & 1U)) continue;
      Matrix3 block = along(i, j) * rr;
      if (exact > 0.0) {
        // −2 b′ Σ G_qp (W_iq r + wᵢ A_q)(W_jp r + wⱼ A_p)ᵀ without its term in rrᵀ, which is in `along`.
        const double scale = 2.0 * b1 * exact;
        block.diagonal().array() += scale * ww(i, j);
        if (f.k > 0) {
          const Eigen::Vector2d gi = gram * f.W.row(i).transpose(), gj = gram * f.W.row(j).transpose();
          const Vector3 ai = f.A * gi, aj = f.A * gj;
          block -= scale * (f.weights[j] * f.r * ai.transpose() + f.weights[i] * aj * f.r.transpose() +
                            ww(i, j) * (f.A * gram * f.A.transpose()));
        }
      }
      out.block<3, 3>(3 * i, 3 * j) = block;
      if (i != j) out.block<3, 3>(3 * j, 3 * i) = block.transpose();
    }
  }
}

/// Derivatives of m b, with m the mollifier of nearly parallel edges, and the PSD projection of the whole. All four
/// terms of the product's second derivative count: without those of m, Newton takes many short steps if edges are
/// parallel.
void mollified_derivatives(const ClosestFeature& feature, double b, double b1, double b2, const EdgeEdgeMollifier& m,
                           double blend, PairLocal& out) {
  const Vector12 ds = squared_distance_gradient(feature);
  out.gradient = m.value * b1 * ds + b * m.gradient;
  const Matrix12 exact = m.value * (b2 * ds * ds.transpose() + b1 * squared_distance_hessian(feature)) +
                         b1 * (ds * m.gradient.transpose() + m.gradient * ds.transpose()) + b * m.hessian;
  out.hessian = exact;
  if (blend == 0.0) return;
  Matrix12 projected = exact;
  project_psd(projected);
  out.hessian = (1.0 - blend) * exact + blend * projected;
}

}  // namespace

ContactBarrier::ContactBarrier(const ContactMesh& mesh, std::vector<ContactPair> pairs, ContactLaws laws)
    : mesh_(&mesh), pairs_(std::move(pairs)), laws_(std::move(laws)), s_hat_(laws_.reach_m() * laws_.reach_m()) {
  if (laws_.all_alike()) return;
  law_of_.reserve(pairs_.size());
  for (const ContactPair& pair : pairs_) law_of_.push_back(static_cast<std::uint16_t>(laws_.index(mesh, pair)));
}

bool ContactBarrier::of_objects_alone(int i) const {
  const auto& v = pairs_[i].vertices;
  return *std::min_element(v.begin(), v.end()) >= mesh_->num_gel_vertices;
}

bool ContactBarrier::of_gel_alone(int i) const {
  const auto& v = pairs_[i].vertices;
  return *std::max_element(v.begin(), v.end()) < mesh_->num_gel_vertices;
}

double ContactBarrier::s_hat_of(int i) const {
  const ContactPair& pair = pairs_[i];
  const double s_hat = law(i).d_hat_m * law(i).d_hat_m;
  if (!of_gel_alone(i) || mesh_->body_of(pair.vertices[0]) != mesh_->body_of(pair.vertices[3])) return s_hat;
  const FourPoints rest = gather(mesh_->rest_positions, pair);
  return std::min(s_hat, 0.25 * closest_feature(pair, rest).squared_distance);
}

double ContactBarrier::mollifier_threshold(int i) const {
  if (pairs_[i].kind != ContactPair::Kind::edge_edge) return 0.0;
  return edge_edge_mollifier_threshold(gather(mesh_->rest_positions, pairs_[i]));
}

ContactBarrier::Push ContactBarrier::push(int i, const FourPoints& points) const {
  Push out{closest_feature(pairs_[i], points), 0.0};
  const double s = out.feature.squared_distance;
  if (s >= s_hat_) return out;
  const double s_hat_i = s_hat_of(i);
  if (s >= s_hat_i) return out;
  out.force = -2.0 * pairs_[i].weight * std::sqrt(s) * barrier_d1(s, s_hat_i);
  if (const double c = edge_cross_squared_norm(points), threshold = mollifier_threshold(i); c < threshold)
    out.force *= edge_edge_mollifier(c, threshold);
  return out;
}

bool ContactBarrier::mollified(int i, const FourPoints& x) const {
  const double threshold = mollifier_threshold(i);
  return threshold > 0.0 && edge_cross_squared_norm(x) < threshold;
}

std::vector<int> ContactBarrier::active(const Positions& x) const { return near_pairs(pairs_, x, s_hat_); }

double ContactBarrier::value_of(int i, const FourPoints& points) const {
  const double s = closest_feature(pairs_[i], points).squared_distance;
  if (s >= s_hat_) return 0.0;
  const double energy = pairs_[i].weight * barrier(s, s_hat_of(i));
  if (energy == 0.0 || !std::isfinite(energy) || !mollified(i, points)) return energy;
  return energy * edge_edge_mollifier(edge_cross_squared_norm(points), mollifier_threshold(i));
}

bool ContactBarrier::evaluate_gradient(int i, const FourPoints& x, Vector12& out) const {
  const ClosestFeature feature = closest_feature(pairs_[i], x);
  const double s = feature.squared_distance;
  if (s >= s_hat_) return false;
  const double s_hat = s_hat_of(i);
  if (s >= s_hat) return false;
  out = barrier_d1(s, s_hat) * squared_distance_gradient(feature);
  if (mollified(i, x)) {
    const EdgeEdgeMollifier m = edge_edge_mollifier(x, mollifier_threshold(i));
    out = m.value * out + barrier(s, s_hat) * m.gradient;
  }
  out *= pairs_[i].weight;
  return true;
}

bool ContactBarrier::evaluate_blended(int i, const FourPoints& x, double blend, PairVertices wanted,
                                      PairLocal& out) const {
  const ClosestFeature feature = closest_feature(pairs_[i], x);
  const double s = feature.squared_distance, weight = pairs_[i].weight;
  if (s >= s_hat_) return false;
  const double s_hat = s_hat_of(i);
  if (s >= s_hat) return false;
  const double b1 = weight * barrier_d1(s, s_hat), b2 = weight * barrier_d2(s, s_hat);
  if (mollified(i, x)) {
    mollified_derivatives(feature, weight * barrier(s, s_hat), b1, b2, edge_edge_mollifier(x, mollifier_threshold(i)),
                          blend, out);
    return true;
  }
  out.gradient = b1 * squared_distance_gradient(feature);
  // A pair of negative weight has no PSD approximation: without it the approximation of the other pairs is stiffer.
  const bool against = weight < 0.0;
  if (against && blend == 1.0) {
    out.hessian.setZero();
    return true;
  }
  blended_hessian(feature, b1, b2, against ? 0.0 : blend, wanted, out.hessian);
  if (against && blend > 0.0) out.hessian *= 1.0 - blend;
  return true;
}

void ContactBarrier::evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const {
  const FourPoints points = four_points(x);
  out.value = value_of(i, points);
  const double s = closest_feature(pairs_[i], points).squared_distance;
  out.zero = s >= s_hat_ || s >= s_hat_of(i);
  if (out.zero || !std::isfinite(out.value) || order == Order::value) return;
  out.fit(4, order);
  if (order == Order::gradient) {
    Vector12 gradient;
    evaluate_gradient(i, points, gradient);
    out.gradient = gradient;
    return;
  }
  PairLocal local;
  evaluate_blended(i, points, order == Order::psd ? 1.0 : 0.0, kAllPairVertices, local);
  out.gradient = local.gradient;
  out.hessian = local.hessian;
}

}  // namespace tacipc
