#include "stages/press/energy/averaged_elasticity.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace tacipc {
namespace {

Matrix3 edges(const TetCorners& x) { return x.rightCols<3>().colwise() - x.col(0); }

/// ∂v/∂x of a tetrahedron's volume v = det(e₁, e₂, e₃)/6: the opposite faces' area vectors over three.
TetCorners volume_gradient(const TetCorners& x) {
  const Matrix3 e = edges(x);
  TetCorners out;
  for (int k = 0; k < 3; ++k) out.col(k + 1) = e.col((k + 1) % 3).cross(e.col((k + 2) % 3)) / 6.0;
  out.col(0) = -out.rightCols<3>().rowwise().sum();
  return out;
}

TetCorners gather(const Eigen::VectorXd& x, const std::array<int, 4>& corners) {
  TetCorners out;
  for (int k = 0; k < 4; ++k) out.col(k) = x.segment<3>(3 * corners[k]);
  return out;
}

}  // namespace

AveragedElasticity::AveragedElasticity(const Positions& rest, const Tetrahedra& tets, const ElasticLaw& law,
                                       const TetPatches& patches)
    : shear_law_(law) {
  std::visit(
      [&](auto& shear) {
        lambda_pa_ = shear.lambda_pa;
        shear.lambda_pa = 0.0;
      },
      shear_law_);
  const std::vector<RestTet> rest_tets = make_rest_tets(rest, tets);
  patches_.reserve(patches.size());
  for (const std::vector<int>& members : patches) {
    Patch patch;
    for (const int t : members) patch.vertices.insert(patch.vertices.end(), &tets(t, 0), &tets(t, 0) + 4);
    std::sort(patch.vertices.begin(), patch.vertices.end());
    patch.vertices.erase(std::unique(patch.vertices.begin(), patch.vertices.end()), patch.vertices.end());
    patch.volume_m3 = 0.0;
    for (const int t : members) {
      Member member{rest_tets[t], {}};
      for (int k = 0; k < 4; ++k) {
        const auto place = std::lower_bound(patch.vertices.begin(), patch.vertices.end(), tets(t, k));
        member.corners[k] = static_cast<int>(place - patch.vertices.begin());
      }
      patch.volume_m3 += member.rest.volume_m3;
      patch.members.push_back(member);
    }
    patches_.push_back(std::move(patch));
  }
}

void AveragedElasticity::evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const {
  const Patch& patch = patches_[i];
  const auto num_vertices = static_cast<Eigen::Index>(patch.vertices.size());
  out.zero = false;
  double v = 0.0;
  for (const Member& member : patch.members) v += edges(gather(x, member.corners)).determinant() / 6.0;
  if (!(v > 0.0)) {
    out.value = std::numeric_limits<double>::infinity();
    return;
  }
  const double V = patch.volume_m3, J = v / V, log_J = std::log(J);
  const double u1 = lambda_pa_ * log_J / J, u2 = lambda_pa_ * (1.0 - log_J) / (V * J * J);
  out.value = V * 0.5 * lambda_pa_ * log_J * log_J;
  out.fit(num_vertices, order);
  Eigen::VectorXd dv;
  if (order >= Order::gradient) {
    out.gradient.setZero();
    dv.setZero(3 * num_vertices);
  }
  if (order >= Order::hessian) out.hessian.setZero();

  Vector12 gradient;
  Matrix12 hessian;
  for (const Member& member : patch.members) {
    const auto& c = member.corners;
    const TetCorners corners = gather(x, c);
    out.value +=
        tet_energy(shear_law_, member.rest, TetPoints(corners.data()), u1, order, {gradient.data(), hessian.data()});
    if (!std::isfinite(out.value)) return;
    if (order == Order::value) continue;
    const TetCorners dv_tet = volume_gradient(corners);
    for (int k = 0; k < 4; ++k) {
      out.gradient.segment<3>(3 * c[k]) += gradient.segment<3>(3 * k);
      dv.segment<3>(3 * c[k]) += dv_tet.col(k);
    }
    if (order == Order::gradient) continue;
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) out.hessian.block<3, 3>(3 * c[k], 3 * c[j]) += hessian.block<3, 3>(3 * k, 3 * j);
    }
  }
  if (order == Order::value) return;
  out.gradient += u1 * dv;
  if (order == Order::gradient) return;
  out.hessian.noalias() += (order == Order::psd ? std::max(u2, 0.0) : u2) * dv * dv.transpose();
}

}  // namespace tacipc
