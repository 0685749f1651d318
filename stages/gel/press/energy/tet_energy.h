// Elastic energy of one tetrahedron for each material law.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "stages/gel/press/energy/energy_term.h"
#include "stages/gel/press/energy/neo_hookean.h"
#include "stages/gel/press/energy/stvk_hencky.h"

namespace tacipc {

/// A hyperelastic law ψ(F) = ψ_μ(F) + λ/2 (ln J)². Each law is a struct of mu_pa and lambda_pa with stress(F) in Pa,
/// and has a tet_energy() below. The volumetric part is the same for all laws, so that an element may average it over
/// several tetrahedra (averaged_elasticity.h).
using ElasticLaw = std::variant<NeoHookean, StvkHencky>;

/// Law by its name in a sensor file: neo_hookean or stvk_hencky. \pre the name is one of these
ElasticLaw make_elastic_law(const std::string& name, double mu_pa, double lambda_pa);

/// Rest shape of a tetrahedron, as its energy needs it.
struct RestTet {
  Eigen::Matrix<double, 3, 4> shape_gradients;  // column i is ∇Nᵢ in 1/m; the columns sum to zero
  double volume_m3;
};

/// Rest shapes of all tetrahedra. \throw DataError that names the first tetrahedron that is not positively oriented
std::vector<RestTet> make_rest_tets(const Positions& rest, const Tetrahedra& tets);

/// One vector per corner of a tetrahedron, a column each; TetPoints maps coordinates that are stored elsewhere.
using TetCorners = Eigen::Matrix<double, 3, 4>;
using TetPoints = Eigen::Map<const TetCorners>;

/// Destination of the derivatives of tet_energy(): 12 and 12 × 12 numbers, first corner first. A pointer may be null if
/// the order does not ask for it.
struct TetDerivatives {
  double* gradient = nullptr;
  double* hessian = nullptr;
};

/// Energy V ψ(F), J, F = Σᵢ xᵢ ∇Nᵢᵀ; +∞ without derivatives for J ≤ 0. Value and gradient are those of ψ alone, but the
/// Hessian is that of V [ψ(F) + p J]: an element that averages volume over several tetrahedra puts them under a common
/// pressure term p (Pa), whose second derivatives must be added before the projection (Order::psd) so that it removes
/// no more than needed.
double tet_energy(const NeoHookean& law, const RestTet& tet, const TetPoints& x, double p, Order order,
                  const TetDerivatives& out);
double tet_energy(const StvkHencky& law, const RestTet& tet, const TetPoints& x, double p, Order order,
                  const TetDerivatives& out);
inline double tet_energy(const ElasticLaw& law, const RestTet& tet, const TetPoints& x, double p, Order order,
                         const TetDerivatives& out) {
  if (const auto* neo_hookean = std::get_if<NeoHookean>(&law)) return tet_energy(*neo_hookean, tet, x, p, order, out);
  return tet_energy(std::get<StvkHencky>(law), tet, x, p, order, out);
}

}  // namespace tacipc
