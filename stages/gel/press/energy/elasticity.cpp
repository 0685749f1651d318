#include "stages/gel/press/energy/elasticity.h"

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <numeric>

#include "common/mesh/spatial_order.h"

namespace tacipc {
namespace {

double signed_volume(const Positions& x, const auto& tet) {
  Matrix3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = x.row(tet[k + 1]) - x.row(tet[0]);
  return edges.determinant() / 6.0;
}

}  // namespace

Elasticity::Elasticity(const Positions& rest, const Tetrahedra& tets, const ElasticLaw& law)
    : tets_(tets), rest_(make_rest_tets(rest, tets)), law_(law) {
  const auto* neo_hookean = std::get_if<NeoHookean>(&law_);
  if (!neo_hookean) return;
  Positions centres(tets.rows(), 3);
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    centres.row(t) = 0.25 * (rest.row(tets(t, 0)) + rest.row(tets(t, 1)) + rest.row(tets(t, 2)) + rest.row(tets(t, 3)));
  }
  rank_ = std::make_shared<const std::vector<int>>(spatial_rank(rest));
  packs_.emplace(tets_, rest_, *neo_hookean, spatial_order(centres), *rank_);
}

Elasticity::Elasticity(const Elasticity& whole, const std::vector<int>& which)
    : tets_(static_cast<Eigen::Index>(which.size()), 4), law_(whole.law_), rank_(whole.rank_) {
  for (const int t : which) {
    tets_.row(static_cast<Eigen::Index>(rest_.size())) = whole.tets_.row(t);
    rest_.push_back(whole.rest_[t]);
  }
  std::vector<int> order(which.size());
  std::iota(order.begin(), order.end(), 0);
  if (const auto* neo_hookean = std::get_if<NeoHookean>(&law_))
    packs_.emplace(tets_, rest_, *neo_hookean, order, *rank_);
}

double Elasticity::value(const Positions& x) const { return packs_ ? packs_->value(x) : EnergyTerm::value(x); }

void Elasticity::evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const {
  out.zero = false;
  out.fit(4, order);
  const TetDerivatives derivatives{out.gradient.data(), out.hessian.data()};
  out.value = tet_energy(law_, rest_[i], TetPoints(x.data()), 0.0, order, derivatives);
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
