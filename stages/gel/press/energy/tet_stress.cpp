#include "stages/gel/press/energy/tet_stress.h"

#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <cmath>
#include <utility>

namespace tacipc {
namespace {

constexpr int kTetsAtATime = 256;

Matrix3 deformation(const RestBody& body, Eigen::Index t, const Positions& x) {
  TetCorners corners;
  for (int k = 0; k < 4; ++k) corners.col(k) = x.row(body.tets(t, k)).transpose();
  return corners * body.rest[static_cast<std::size_t>(t)].shape_gradients.transpose();
}

/// Stores the mean of both triangles, which agree to rounding.
void put_symmetric(const Matrix3& m, SymmetricRows& rows, Eigen::Index t) {
  rows.row(t) << m(0, 0), m(1, 1), m(2, 2), 0.5 * (m(1, 2) + m(2, 1)), 0.5 * (m(0, 2) + m(2, 0)),
      0.5 * (m(0, 1) + m(1, 0));
}

}  // namespace

TetStress::TetStress(std::shared_ptr<const RestBody> body, const ElasticLaw& law, TetClusters clusters)
    : body_(std::move(body)), law_(law), clusters_(std::move(clusters)) {
  if (clusters_.empty()) return;
  std::visit([&](auto& shear) { lambda_pa_ = std::exchange(shear.lambda_pa, 0.0); }, law_);
}

SymmetricRows TetStress::operator()(const Positions& x) const {
  std::vector<double> pressure(body_->rest.size(), 0.0);  // u′ of the cluster of each tetrahedron
  tbb::parallel_for(std::size_t{0}, clusters_.size(), [&](std::size_t c) {
    double rest_volume = 0.0, volume = 0.0;
    for (const int t : clusters_[c]) {
      rest_volume += body_->rest[static_cast<std::size_t>(t)].volume_m3;
      volume += body_->rest[static_cast<std::size_t>(t)].volume_m3 * deformation(*body_, t, x).determinant();
    }
    const double J = volume / rest_volume;
    for (const int t : clusters_[c]) pressure[static_cast<std::size_t>(t)] = lambda_pa_ * std::log(J) / J;
  });
  SymmetricRows out(body_->tets.rows(), 6);
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, out.rows(), kTetsAtATime), [&](const auto& range) {
    for (Eigen::Index t = range.begin(); t < range.end(); ++t) {
      const Matrix3 F = deformation(*body_, t, x), inverse = F.inverse();
      const Matrix3 P = std::visit([&](const auto& law) { return law.stress(F); }, law_);
      const Matrix3 S = inverse * (P + pressure[static_cast<std::size_t>(t)] * F.determinant() * inverse.transpose());
      put_symmetric(S, out, t);
    }
  });
  return out;
}

SymmetricRows cauchy_stress(const RestBody& body, const Positions& x, const SymmetricRows& second_pa) {
  SymmetricRows out(body.tets.rows(), 6);
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, out.rows(), kTetsAtATime), [&](const auto& range) {
    for (Eigen::Index t = range.begin(); t < range.end(); ++t) {
      const Matrix3 F = deformation(body, t, x);
      put_symmetric(F * symmetric(second_pa, t) * F.transpose() / F.determinant(), out, t);
    }
  });
  return out;
}

}  // namespace tacipc
