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

}  // namespace

TetStress::TetStress(std::shared_ptr<const RestBody> body, const ElasticLaw& law, TetClusters clusters)
    : body_(std::move(body)), law_(law), clusters_(std::move(clusters)) {
  if (clusters_.empty()) return;
  std::visit([&](auto& shear) { lambda_pa_ = std::exchange(shear.lambda_pa, 0.0); }, law_);
}

SymmetricRows TetStress::operator()(const Positions& x) const {
  std::vector<double> pressure(body_->rest.size(), 0.0);  // u′ of its cluster
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
      out.row(t) << S(0, 0), S(1, 1), S(2, 2), 0.5 * (S(1, 2) + S(2, 1)), 0.5 * (S(0, 2) + S(2, 0)),
          0.5 * (S(0, 1) + S(1, 0));
    }
  });
  return out;
}

}  // namespace tacipc
