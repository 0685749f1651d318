// Which elastic energy a gel gets: its material law over its elements.
#pragma once

#include <memory>

#include "stages/gel/press/energy/energy_term.h"
#include "stages/gel/press/energy/tet_stress.h"

namespace tacipc {

/// `linear`: each tetrahedron by itself; compressible gels. `averaged_volume`: tetrahedra share their volume in
/// clusters; for any ratio up to 0.4999. docs/elements.md compares them.
enum class Element { linear, averaged_volume };

/// Tetrahedra that share one measure of volume.
constexpr int kClusterSize = 12;

/// One term whose stencils cover all tetrahedra, in J. \throw DataError naming the first tetrahedron that is not
/// positively oriented.
std::shared_ptr<const EnergyTerm> make_elasticity(const Positions& rest, const Tetrahedra& tets, const ElasticLaw& law,
                                                  Element element);

/// The stress in its tetrahedra. \throw the same
TetStress make_tet_stress(const Positions& rest, const Tetrahedra& tets, const ElasticLaw& law, Element element);

}  // namespace tacipc
