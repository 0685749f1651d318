#include "stages/press/energy/averaged_elasticity.h"

#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/spatial_order.h"

namespace tacipc {
namespace {

constexpr int kPacksAtATime = 128;

Matrix3 edges(const TetCorners& x) { return x.rightCols<3>().colwise() - x.col(0); }

/// ∂v/∂x of a tetrahedron's volume v = det(e₁, e₂, e₃)/6: the opposite faces' area vectors over three.
TetCorners tet_volume_gradient(const TetCorners& x) {
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

/// u(v) = V λ/2 ln²(v/V) of a patch, J, and its derivatives.
struct VolumeEnergy {
  double value, first, second;

  VolumeEnergy(double V, double v, double lambda) {
    const double J = v / V, log_J = std::log(J);
    value = V * 0.5 * lambda * log_J * log_J;
    first = lambda * log_J / J;
    second = lambda * (1.0 - log_J) / (V * J * J);
  }
};

/// Places of the patches' centres along a space-filling curve.
std::vector<int> along_curve(const Positions& rest, const Tetrahedra& tets, const TetPatches& patches) {
  Positions centres(static_cast<Eigen::Index>(patches.size()), 3);
  for (std::size_t p = 0; p < patches.size(); ++p) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (const int t : patches[p]) {
      for (int k = 0; k < 4; ++k) sum += rest.row(tets(t, k));
    }
    centres.row(static_cast<Eigen::Index>(p)) = sum / (4.0 * static_cast<double>(patches[p].size()));
  }
  return spatial_order(centres);
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
  for (const int p : along_curve(rest, tets, patches)) {
    const std::vector<int>& members = patches[static_cast<std::size_t>(p)];
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
  rank_ = std::make_shared<const std::vector<int>>(spatial_rank(rest));
  make_packs();
}

AveragedElasticity::AveragedElasticity(const AveragedElasticity& whole, const std::vector<int>& which)
    : shear_law_(whole.shear_law_), lambda_pa_(whole.lambda_pa_), rank_(whole.rank_) {
  patches_.reserve(which.size());
  for (const int p : which) patches_.push_back(whole.patches_[static_cast<std::size_t>(p)]);
  make_packs();
}

void AveragedElasticity::make_packs() {
  const auto* neo_hookean = std::get_if<NeoHookean>(&shear_law_);
  if (!neo_hookean) return;
  first_place_.assign(1, 0);
  for (const Patch& patch : patches_)
    first_place_.push_back(first_place_.back() + static_cast<int>(patch.members.size()));
  Tetrahedra tets(first_place_.back(), 4);
  std::vector<RestTet> rest;
  for (const Patch& patch : patches_) {
    for (const Member& member : patch.members) {
      for (int k = 0; k < 4; ++k)
        tets(static_cast<Eigen::Index>(rest.size()), k) = patch.vertices[static_cast<std::size_t>(member.corners[k])];
      rest.push_back(member.rest);
    }
  }
  std::vector<int> order(rest.size());
  std::iota(order.begin(), order.end(), 0);
  packs_.emplace(tets, rest, *neo_hookean, order, *rank_);
}

std::vector<double> AveragedElasticity::patch_volumes(const Positions& x) const {
  std::vector<double> of_tets(static_cast<std::size_t>(kLanes * packs_->size()));
  tbb::parallel_for(tbb::blocked_range<int>(0, packs_->size(), kPacksAtATime), [&](const auto& range) {
    for (int i = range.begin(); i < range.end(); ++i)
      packs_->volumes(i, x, &of_tets[static_cast<std::size_t>(kLanes * i)]);
  });
  std::vector<double> volumes(patches_.size(), 0.0);
  for (std::size_t p = 0; p < volumes.size(); ++p) {
    for (int place = first_place_[p]; place < first_place_[p + 1]; ++place)
      volumes[p] += of_tets[static_cast<std::size_t>(place)];
  }
  return volumes;
}

double AveragedElasticity::value(const Positions& x) const {
  if (!packs_) return EnergyTerm::value(x);
  const double shear = packs_->value(x);
  if (!std::isfinite(shear)) return shear;  // a tetrahedron inside out; else no patch is
  const std::vector<double> volumes = patch_volumes(x);
  return shear + ordered_sum(num_stencils(), [&](int first, int last) {
           double sum = 0.0;
           for (int i = first; i < last; ++i) sum += VolumeEnergy(patches_[i].volume_m3, volumes[i], lambda_pa_).value;
           return sum;
         });
}

AveragedElasticity::VolumeDerivatives AveragedElasticity::volume_derivatives(const Positions& x) const {
  const std::vector<double> volumes = patch_volumes(x);
  VolumeDerivatives out{std::vector<double>(static_cast<std::size_t>(kLanes * packs_->size()), 0.0),
                        std::vector<double>(patches_.size())};
  for (std::size_t p = 0; p < volumes.size(); ++p) {
    const VolumeEnergy u(patches_[p].volume_m3, volumes[p], lambda_pa_);
    for (int place = first_place_[p]; place < first_place_[p + 1]; ++place)
      out.pressure[static_cast<std::size_t>(place)] = u.first;
    out.second[p] = u.second;
  }
  return out;
}

void AveragedElasticity::volume_gradient(int i, const Positions& x, Eigen::Matrix3Xd& out) const {
  const Patch& patch = patches_[static_cast<std::size_t>(i)];
  out.setZero(3, static_cast<Eigen::Index>(patch.vertices.size()));
  for (const Member& member : patch.members) {
    TetCorners corners;
    for (int k = 0; k < 4; ++k)
      corners.col(k) = x.row(patch.vertices[static_cast<std::size_t>(member.corners[k])]).transpose();
    const TetCorners of_tet = tet_volume_gradient(corners);
    for (int k = 0; k < 4; ++k) out.col(member.corners[k]) += of_tet.col(k);
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
  const VolumeEnergy u(patch.volume_m3, v, lambda_pa_);
  out.value = u.value;
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
    out.value += tet_energy(shear_law_, member.rest, TetPoints(corners.data()), u.first, order,
                            {gradient.data(), hessian.data()});
    if (!std::isfinite(out.value)) return;
    if (order == Order::value) continue;
    const TetCorners dv_tet = tet_volume_gradient(corners);
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
  out.gradient += u.first * dv;
  if (order == Order::gradient) return;
  out.hessian.noalias() += (order == Order::psd ? std::max(u.second, 0.0) : u.second) * dv * dv.transpose();
}

}  // namespace tacipc
