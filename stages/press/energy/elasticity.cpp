#include "stages/press/energy/elasticity.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.h"

namespace tacipc {
namespace {

double signed_volume(const Positions& x, const auto& tet) {
  Matrix3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = x.row(tet[k + 1]) - x.row(tet[0]);
  return edges.determinant() / 6.0;
}

}  // namespace

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

Elasticity::Elasticity(const Positions& rest, const Tetrahedra& tets, NeoHookean material)
    : tets_(tets), rest_(make_rest_tets(rest, tets)), material_(material) {}

void Elasticity::evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const {
  const RestTet& tet = rest_[i];
  const auto& b = tet.shape_gradients;
  const double V = tet.volume_m3, mu = material_.mu_pa, lambda = material_.lambda_pa;
  const Matrix3 F = Eigen::Map<const Eigen::Matrix<double, 3, 4>>(x.data()) * b.transpose();
  out.zero = false;
  const double J = F.determinant();
  if (!(J > 0.0)) {
    out.value = std::numeric_limits<double>::infinity();
    return;
  }
  const double log_J = std::log(J);
  // tr FᵀF − 3 written in F − I, so that a gel at rest has no energy of rounding.
  const Matrix3 D = F - Matrix3::Identity();
  out.value = V * (0.5 * mu * (D.squaredNorm() + 2.0 * D.trace()) - mu * log_J + 0.5 * lambda * log_J * log_J);
  if (order == Order::value) return;
  out.fit(4, order);

  const double a = mu - lambda * log_J;
  const Eigen::Matrix<double, 3, 4> g = F.inverse().transpose() * b;  // gᵢ = F⁻ᵀ ∇Nᵢ
  Eigen::Map<Eigen::Matrix<double, 3, 4>>(out.gradient.data()) = V * (mu * F * b - a * g);
  if (order == Order::gradient) return;

  // ∂²/∂xᵢ∂xⱼ = V [μ (bᵢ·bⱼ) I + a gⱼ gᵢᵀ + λ gᵢ gⱼᵀ], from δP of neo_hookean.h with δF = δxⱼ bⱼᵀ.
  Eigen::Map<Matrix12> hessian(out.hessian.data());
  const Eigen::Matrix4d gram = V * mu * (b.transpose() * b);
  for (int j = 0; j < 4; ++j) {
    for (int k = 0; k < 4; ++k) {
      auto block = hessian.block<3, 3>(3 * k, 3 * j);
      block = V * (a * g.col(j) * g.col(k).transpose() + lambda * g.col(k) * g.col(j).transpose());
      block.diagonal().array() += gram(k, j);
    }
  }
  if (order == Order::hessian) return;

  NegativeMode modes[6];
  const int count = negative_modes(material_, F, modes);
  for (int m = 0; m < count; ++m) {
    const Eigen::Matrix<double, 3, 4> q = modes[m].Q * b;
    const Eigen::Map<const Vector12> direction(q.data());
    hessian.noalias() -= V * modes[m].value * direction * direction.transpose();
  }
}

Eigen::VectorXd lumped_masses(const Tetrahedra& tets, const std::vector<RestTet>& rest, Eigen::Index num_vertices,
                              double density_kg_m3) {
  Eigen::VectorXd mass_kg = Eigen::VectorXd::Zero(num_vertices);
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    for (int k = 0; k < 4; ++k) mass_kg[tets(t, k)] += 0.25 * density_kg_m3 * rest[t].volume_m3;
  }
  return mass_kg;
}

double min_volume_ratio(const Positions& x, const Tetrahedra& tets, const std::vector<RestTet>& rest) {
  double smallest = std::numeric_limits<double>::infinity();
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    smallest = std::min(smallest, signed_volume(x, tets.row(t)) / rest[t].volume_m3);
  return smallest;
}

}  // namespace tacipc
