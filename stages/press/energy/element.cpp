#include "stages/press/energy/element.h"

#include "stages/press/energy/averaged_elasticity.h"
#include "stages/press/energy/elasticity.h"

namespace tacipc {

std::shared_ptr<const EnergyTerm> make_elasticity(const Positions& rest, const Tetrahedra& tets, const ElasticLaw& law,
                                                  Element element) {
  if (element == Element::linear) return std::make_shared<Elasticity>(rest, tets, law);
  return std::make_shared<AveragedElasticity>(rest, tets, law, make_tet_patches(tets, kPatchSize));
}

}  // namespace tacipc
