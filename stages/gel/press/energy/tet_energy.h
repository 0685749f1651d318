// Elastic energy of one tetrahedron under either material law.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "stages/gel/press/energy/energy_term.h"
#include "stages/gel/press/energy/neo_hookean.h"
#include "stages/gel/press/energy/stvk_hencky.h"

namespace tacipc {

/// A hyperelastic law ψ(F) = ψ_μ(F) + λ/2 (ln J)². Each is a struct of mu_pa and lambda_pa with stress(F) in Pa, and
/// has a tet_energy below. The volumetric part is the same in all, so that an element may take it over more than one
/// tetrahedron (averaged_elasticity.h).
using ElasticLaw = std::variant<NeoHookean, StvkHencky>;

/// By the name a sensor file gives it: neo_hookean or stvk_hencky. \pre one of those
ElasticLaw make_elastic_law(const std::string& name, double mu_pa, double lambda_pa);

/// What the energy needs of a tetrahedron's rest shape.
struct RestTet {
  Eigen::Matrix<double, 3, 4> shape_gradients;  // column i is ∇Nᵢ in 1/m; the columns sum to zero
  double volume_m3;
};

/// \throw DataError naming the first tetrahedron that is not positively oriented.
std::vector<RestTet> make_rest_tets(const Positions& rest, const Tetrahedra& tets);

/// One vector per corner of a tetrahedron, a column each; TetPoints maps coordinates that are stored elsewhere.
using TetCorners = Eigen::Matrix<double, 3, 4>;
using TetPoints = Eigen::Map<const TetCorners>;

/// Where tet_energy puts what its order asks for: 12 and 12 × 12 numbers, first corner first. May stay empty otherwise.
struct TetDerivatives {
  double* gradient = nullptr;
  double* hessian = nullptr;
};

/// V ψ(F) in J, F = Σᵢ xᵢ ∇Nᵢᵀ; +∞, and no derivatives, for J ≤ 0. The Hessian is that of V [ψ(F) + p J]: an element
/// that takes volume over several tetrahedra holds them under a common pressure term p (Pa), whose second derivatives
/// must be added before the projection (Order::psd), so that it removes no more than needed. Value and gradient are of
/// ψ alone.
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
