// Pressure and shear on the front: of the contact forces, and of the stress in the gel behind it. The normal of a
// vertex is the mean of the triangles around, weighted with their areas.
#pragma once

#include <vector>

#include "common/base/symmetric_rows.h"
#include "common/sample/press_folder.h"
#include "stages/gel/press/measure/front_surface.h"

namespace tacipc {

/// Tetrahedron behind each triangle of the front. \pre each triangle is a side of one
std::vector<int> tets_behind(const FrontSurface& front, const Tetrahedra& tets);

/// t is the contact force on a vertex over its share of the area, a third of each triangle around: the traction that
/// balances the stress in the mean over the vertex (nodal forces are what ∫ σ ∇Nᵢ leaves). Zero where there is no area.
FrontTraction traction_of_forces(const FrontSurface& front, const Positions& front_positions, const Positions& force_n);

/// t = σ n, the mean over the triangles around a vertex weighted with their areas, σ of the tetrahedron behind each.
/// Stress is constant in a tetrahedron, so this agrees with the other only as the mesh gets finer, and lags behind at
/// the rim of a contact. \param stress_pa Cauchy stress of each tetrahedron \param behind tets_behind()
FrontTraction traction_of_stress(const FrontSurface& front, const Positions& front_positions,
                                 const SymmetricRows& stress_pa, const std::vector<int>& behind);

}  // namespace tacipc
