#include "stages/gel/press/energy/averaged_elasticity.h"

#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/mesh/spatial_order.h"

namespace tacipc {
namespace {

constexpr int kPacksAtATime = 128;

Matrix3 edges(const TetCorners& x) { return x.rightCols<3>().colwise() - x.col(0); }

/// Gradient ∂v/∂x of a tetrahedron's volume v = det(e₁, e₂, e₃)/6: the opposite faces' area vectors over three.
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

/// Volumetric energy u(v) = V λ/2 ln²(v/V) of a cluster, J, and its derivatives.
struct VolumeEnergy {
  double value, first, second;

  VolumeEnergy(double V, double v, double lambda) {
    const double J = v / V, log_J = std::log(J);
    value = V * 0.5 * lambda * log_J * log_J;
    first = lambda * log_J / J;
    second = lambda * (1.0 - log_J) / (V * J * J);
  }
};

/// Rank of the clusters' centres along a space-filling curve.
std::vector<int> along_curve(const Positions& rest, const Tetrahedra& tets, const TetClusters& clusters) {
  Positions centres(static_cast<Eigen::Index>(clusters.size()), 3);
  for (std::size_t p = 0; p < clusters.size(); ++p) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (const int t : clusters[p]) {
      for (int k = 0; k < 4; ++k) sum += rest.row(tets(t, k));
    }
    centres.row(static_cast<Eigen::Index>(p)) = sum / (4.0 * static_cast<double>(clusters[p].size()));
  }
  return spatial_order(centres);
}

}  // namespace

AveragedElasticity::AveragedElasticity(const Positions& rest, const Tetrahedra& tets, const ElasticLaw& law,
                                       const TetClusters& clusters)
    : shear_law_(law) {
  std::visit(
      [&](auto& shear) {
        lambda_pa_ = shear.lambda_pa;
        shear.lambda_pa = 0.0;
      },
      shear_law_);
  const std::vector<RestTet> rest_tets = make_rest_tets(rest, tets);
  clusters_.reserve(clusters.size());
  for (const int p : along_curve(rest, tets, clusters)) {
    const std::vector<int>& members = clusters[static_cast<std::size_t>(p)];
    Cluster cluster;
    for (const int t : members) cluster.vertices.insert(cluster.vertices.end(), &tets(t, 0), &tets(t, 0) + 4);
    std::sort(cluster.vertices.begin(), cluster.vertices.end());
    cluster.vertices.erase(std::unique(cluster.vertices.begin(), cluster.vertices.end()), cluster.vertices.end());
    cluster.volume_m3 = 0.0;
    for (const int t : members) {
      Member member{rest_tets[t], {}};
      for (int k = 0; k < 4; ++k) {
        const auto place = std::lower_bound(cluster.vertices.begin(), cluster.vertices.end(), tets(t, k));
        member.corners[k] = static_cast<int>(place - cluster.vertices.begin());
      }
      cluster.volume_m3 += member.rest.volume_m3;
      cluster.members.push_back(member);
    }
    clusters_.push_back(std::move(cluster));
  }
  rank_ = std::make_shared<const std::vector<int>>(spatial_rank(rest));
  make_packs();
}

AveragedElasticity::AveragedElasticity(const AveragedElasticity& whole, const std::vector<int>& which)
    : shear_law_(whole.shear_law_), lambda_pa_(whole.lambda_pa_), rank_(whole.rank_) {
  clusters_.reserve(which.size());
  for (const int p : which) clusters_.push_back(whole.clusters_[static_cast<std::size_t>(p)]);
  make_packs();
}

void AveragedElasticity::make_packs() {
  const auto* neo_hookean = std::get_if<NeoHookean>(&shear_law_);
  if (!neo_hookean) return;
  first_place_.assign(1, 0);
  for (const Cluster& cluster : clusters_)
    first_place_.push_back(first_place_.back() + static_cast<int>(cluster.members.size()));
  Tetrahedra tets(first_place_.back(), 4);
  std::vector<RestTet> rest;
  for (const Cluster& cluster : clusters_) {
    for (const Member& member : cluster.members) {
      for (int k = 0; k < 4; ++k)
        tets(static_cast<Eigen::Index>(rest.size()), k) = cluster.vertices[static_cast<std::size_t>(member.corners[k])];
      rest.push_back(member.rest);
    }
  }
  std::vector<int> order(rest.size());
  std::iota(order.begin(), order.end(), 0);
  packs_.emplace(tets, rest, *neo_hookean, order, *rank_);
}

std::vector<double> AveragedElasticity::cluster_volumes(const Positions& x) const {
  std::vector<double> of_tets(static_cast<std::size_t>(kLanes * packs_->size()));
  tbb::parallel_for(tbb::blocked_range<int>(0, packs_->size(), kPacksAtATime), [&](const auto& range) {
    for (int i = range.begin(); i < range.end(); ++i)
      packs_->volumes(i, x, &of_tets[static_cast<std::size_t>(kLanes * i)]);
  });
  std::vector<double> volumes(clusters_.size(), 0.0);
  for (std::size_t p = 0; p < volumes.size(); ++p) {
    for (int place = first_place_[p]; place < first_place_[p + 1]; ++place)
      volumes[p] += of_tets[static_cast<std::size_t>(place)];
  }
  return volumes;
}

double AveragedElasticity::value(const Positions& x) const {
  if (!packs_) return EnergyTerm::value(x);
  const double shear = packs_->value(x);
  if (!std::isfinite(shear)) return shear;  // an inverted tetrahedron; without one no cluster is inverted
  const std::vector<double> volumes = cluster_volumes(x);
  return shear + ordered_sum(num_stencils(), [&](int first, int last) {
           double sum = 0.0;
           for (int i = first; i < last; ++i) sum += VolumeEnergy(clusters_[i].volume_m3, volumes[i], lambda_pa_).value;
           return sum;
         });
}

AveragedElasticity::VolumeDerivatives AveragedElasticity::volume_derivatives(const Positions& x) const {
  const std::vector<double> volumes = cluster_volumes(x);
  VolumeDerivatives out{std::vector<double>(static_cast<std::size_t>(kLanes * packs_->size()), 0.0),
                        std::vector<double>(clusters_.size())};
  for (std::size_t p = 0; p < volumes.size(); ++p) {
    const VolumeEnergy u(clusters_[p].volume_m3, volumes[p], lambda_pa_);
    for (int place = first_place_[p]; place < first_place_[p + 1]; ++place)
      out.pressure[static_cast<std::size_t>(place)] = u.first;
    out.second[p] = u.second;
  }
  return out;
}

void AveragedElasticity::volume_gradient(int i, const Positions& x, Eigen::Matrix3Xd& out) const {
  const Cluster& cluster = clusters_[static_cast<std::size_t>(i)];
  out.setZero(3, static_cast<Eigen::Index>(cluster.vertices.size()));
  for (const Member& member : cluster.members) {
    TetCorners corners;
    for (int k = 0; k < 4; ++k)
      corners.col(k) = x.row(cluster.vertices[static_cast<std::size_t>(member.corners[k])]).transpose();
    const TetCorners of_tet = tet_volume_gradient(corners);
    for (int k = 0; k < 4; ++k) out.col(member.corners[k]) += of_tet.col(k);
  }
}

void AveragedElasticity::evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const {
  const Cluster& cluster = clusters_[i];
  const auto num_vertices = static_cast<Eigen::Index>(cluster.vertices.size());
  out.zero = false;
  double v = 0.0;
  for (const Member& member : cluster.members) v += edges(gather(x, member.corners)).determinant() / 6.0;
  if (!(v > 0.0)) {
    out.value = std::numeric_limits<double>::infinity();
    return;
  }
  const VolumeEnergy u(cluster.volume_m3, v, lambda_pa_);
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
  for (const Member& member : cluster.members) {
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
