// Which elastic energy a gel gets: its material law over its elements.
#pragma once

#include <memory>

#include "stages/press/energy/energy_term.h"
#include "stages/press/energy/tet_energy.h"

namespace tacipc {

/// `linear`: each tetrahedron by itself; compressible gels. `averaged_volume`: tetrahedra share their volume in
/// patches; for any ratio up to 0.4999. docs/elements.md compares them.
enum class Element { linear, averaged_volume };

/// Poisson's ratio from which averaged_volume is the better choice: less error of the force for the same time
/// (docs/performance.md).
constexpr double kAveragedVolumeFrom = 0.4;

/// Tetrahedra that share one measure of volume.
constexpr int kPatchSize = 12;

/// One term whose stencils cover all tetrahedra, in J. \throw DataError naming the first tetrahedron that is not
/// positively oriented.
std::shared_ptr<const EnergyTerm> make_elasticity(const Positions& rest, const Tetrahedra& tets, const ElasticLaw& law,
                                                  Element element);

}  // namespace tacipc
