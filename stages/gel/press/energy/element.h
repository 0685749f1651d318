// Elastic energy of a gel: its material law combined with an element.
#pragma once

#include <memory>

#include "stages/gel/press/energy/energy_term.h"
#include "stages/gel/press/energy/tet_stress.h"

namespace tacipc {

/// Element type. `linear`: each tetrahedron by itself, for compressible gels. `averaged_volume`: tetrahedra share their
/// volume in clusters, for any Poisson's ratio up to 0.4999. docs/elements.md compares them.
enum class Element { linear, averaged_volume };

/// Number of tetrahedra in a cluster, which share one volume.
constexpr int kClusterSize = 12;

/// Energy over all tetrahedra as one term, J.
/// \throw DataError that names the first tetrahedron that is not positively oriented
std::shared_ptr<const EnergyTerm> make_elasticity(const Positions& rest, const Tetrahedra& tets, const ElasticLaw& law,
                                                  Element element);

/// Stress in the tetrahedra. \throw DataError as make_elasticity()
TetStress make_tet_stress(const Positions& rest, const Tetrahedra& tets, const ElasticLaw& law, Element element);

}  // namespace tacipc
