#include "stages/gel/press/energy/tet_energy.h"

#include <Eigen/LU>
#include <cassert>
#include <cmath>
#include <limits>

#include "common/base/error.h"

namespace tacipc {

ElasticLaw make_elastic_law(const std::string& name, double mu_pa, double lambda_pa) {
  assert(name == "neo_hookean" || name == "stvk_hencky");
  if (name == "stvk_hencky") return StvkHencky{mu_pa, lambda_pa};
  return NeoHookean{mu_pa, lambda_pa};
}

std::vector<RestTet> make_rest_tets(const Positions& rest, const Tetrahedra& tets) {
  std::vector<RestTet> out(static_cast<std::size_t>(tets.rows()));
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    Matrix3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = rest.row(tets(t, k + 1)) - rest.row(tets(t, 0));
    const double volume = edges.determinant() / 6.0;
    if (!(volume > 0.0))
      throw DataError("tetrahedron {} has volume {:.3g} m³ at rest, expected a positive one", t, volume);
    // x(X) = F X + c on the tetrahedron: the rows of edges⁻¹ are the gradients of N₁ … N₃, and ΣN = 1 gives N₀.
    const Matrix3 inverse = edges.inverse();
    out[t].shape_gradients.rightCols<3>() = inverse.transpose();
    out[t].shape_gradients.col(0) = -inverse.colwise().sum().transpose();
    out[t].volume_m3 = volume;
  }
  return out;
}

double tet_energy(const NeoHookean& law, const RestTet& tet, const TetPoints& x, double p, Order order,
                  const TetDerivatives& out) {
  const auto& b = tet.shape_gradients;
  const double V = tet.volume_m3, mu = law.mu_pa, lambda = law.lambda_pa;
  const Matrix3 F = x * b.transpose();
  const double J = F.determinant();
  if (!(J > 0.0)) return std::numeric_limits<double>::infinity();
  const double log_J = std::log(J);
  // tr FᵀF − 3 as a function of F − I, so that a gel at rest has no rounding energy.
  const Matrix3 D = F - Matrix3::Identity();
  const double value = V * (0.5 * mu * (D.squaredNorm() + 2.0 * D.trace()) - mu * log_J + 0.5 * lambda * log_J * log_J);
  if (order == Order::value) return value;

  const double a = mu - lambda * log_J;
  const TetCorners g = F.inverse().transpose() * b;  // gᵢ = F⁻ᵀ ∇Nᵢ
  Eigen::Map<TetCorners>(out.gradient) = V * (mu * F * b - a * g);
  if (order == Order::gradient) return value;

  // ∂²/∂xᵢ∂xⱼ = V [μ (bᵢ·bⱼ) I + α gⱼ gᵢᵀ + β gᵢ gⱼᵀ], from δP of neo_hookean.h with δF = δxⱼ bⱼᵀ; p ∂²J contributes −p
  // J to α and p J to β.
  const double alpha = a - p * J, beta = lambda + p * J;
  Eigen::Map<Matrix12> hessian(out.hessian);
  const Eigen::Matrix4d gram = V * mu * (b.transpose() * b);
  for (int j = 0; j < 4; ++j) {
    for (int k = 0; k < 4; ++k) {
      auto block = hessian.block<3, 3>(3 * k, 3 * j);
      block = V * (alpha * g.col(j) * g.col(k).transpose() + beta * g.col(k) * g.col(j).transpose());
      block.diagonal().array() += gram(k, j);
    }
  }
  if (order == Order::hessian) return value;

  NegativeMode modes[6];
  const int count = negative_modes(law, F, p, modes);
  for (int m = 0; m < count; ++m) {
    const TetCorners q = modes[m].Q * b;
    const Eigen::Map<const Vector12> direction(q.data());
    hessian.noalias() -= V * modes[m].value * direction * direction.transpose();
  }
  return value;
}

double tet_energy(const StvkHencky& law, const RestTet& tet, const TetPoints& x, double p, Order order,
                  const TetDerivatives& out) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double V = tet.volume_m3;
  const Matrix3 F = x * tet.shape_gradients.transpose();
  if (!(F.determinant() > 0.0)) return kInfinity;
  const PrincipalStretches s = principal_stretches(F);
  const double value = V * law.principal_energy(s.sigma);
  if (!std::isfinite(value)) return kInfinity;
  if (order == Order::value) return value;

  const TetCorners b = s.V.transpose() * tet.shape_gradients;  // shape gradients in the principal frame
  Eigen::Map<TetCorners>(out.gradient) = V * (s.U * (law.principal_stress(s.sigma).asDiagonal() * b));
  if (order == Order::gradient) return value;

  PrincipalTangent tangent = law.principal_tangent(s.sigma);
  if (p != 0.0) tangent.add_pressure(p, s.sigma);
  if (order == Order::psd) tangent.project();
  // In the principal frame δP_pq = straight_pq δF_pq + crossed_pq δF_qp (p ≠ q), δP_pp = Σ_q stretch_pq δF_qq, with δF
  // = δxⱼ bⱼᵀ and the force P bᵢ of vertex i.
  Matrix3 straight, crossed = tangent.stretch;
  for (int r = 0; r < 3; ++r) {
    const int m = (r + 1) % 3, n = (r + 2) % 3;
    straight(r, r) = 0.0;
    straight(m, n) = straight(n, m) = 0.5 * (tangent.twist[r] + tangent.flip[r]);
    crossed(m, n) = crossed(n, m) = 0.5 * (tangent.flip[r] - tangent.twist[r]);
  }
  Eigen::Map<Matrix12> hessian(out.hessian);
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i <= j; ++i) {
      Matrix3 block = tangent.stretch.cwiseProduct(b.col(i) * b.col(j).transpose());
      block += (crossed.cwiseProduct(b.col(j) * b.col(i).transpose()));
      block.diagonal() -= tangent.stretch.diagonal().cwiseProduct(b.col(i)).cwiseProduct(b.col(j));
      block.diagonal() += straight * b.col(i).cwiseProduct(b.col(j));
      const Matrix3 turned = V * (s.U * block * s.U.transpose());
      hessian.block<3, 3>(3 * i, 3 * j) = turned;
      hessian.block<3, 3>(3 * j, 3 * i) = turned.transpose();
    }
  }
  return value;
}

}  // namespace tacipc
