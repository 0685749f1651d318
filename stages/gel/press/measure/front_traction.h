// Pressure and shear on the front, from the contact forces or from the stress in the gel behind it. The normal at a
// vertex is the area-weighted mean over the triangles around it.
#pragma once

#include <vector>

#include "common/base/symmetric_rows.h"
#include "common/sample/press_folder.h"
#include "stages/gel/press/measure/front_surface.h"

namespace tacipc {

/// Tetrahedron behind each triangle of the front. \pre each triangle is a side of a tetrahedron
std::vector<int> tets_behind(const FrontSurface& front, const Tetrahedra& tets);

/// Traction by the contact forces: force on a vertex over its lumped area, a third of each triangle around it. It
/// balances the stress on average over the vertex, because nodal forces are the remainder of ∫ σ ∇Nᵢ. Zero for a vertex
/// without area.
FrontTraction traction_of_forces(const FrontSurface& front, const Positions& front_positions, const Positions& force_n);

/// Traction by the stress: t = σ n, with σ of the tetrahedron behind each triangle, as the area-weighted mean over the
/// triangles around a vertex. Stress is constant in a tetrahedron, so this converges to traction_of_forces() only as
/// the mesh is refined, and is inaccurate at the rim of a contact.
/// \param stress_pa Cauchy stress of each tetrahedron
/// \param behind tets_behind()
FrontTraction traction_of_stress(const FrontSurface& front, const Positions& front_positions,
                                 const SymmetricRows& stress_pa, const std::vector<int>& behind);

}  // namespace tacipc
