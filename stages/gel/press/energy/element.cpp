#include "stages/gel/press/energy/element.h"

#include "stages/gel/press/energy/averaged_elasticity.h"
#include "stages/gel/press/energy/elasticity.h"

namespace tacipc {

std::shared_ptr<const EnergyTerm> make_elasticity(const Positions& rest, const Tetrahedra& tets, const ElasticLaw& law,
                                                  Element element) {
  if (element == Element::linear) return std::make_shared<Elasticity>(rest, tets, law);
  return std::make_shared<AveragedElasticity>(rest, tets, law, make_tet_clusters(tets, kClusterSize));
}

TetStress make_tet_stress(const Positions& rest, const Tetrahedra& tets, const ElasticLaw& law, Element element) {
  auto body = std::make_shared<const RestBody>(RestBody{tets, make_rest_tets(rest, tets)});
  if (element == Element::linear) return {std::move(body), law, {}};
  return {std::move(body), law, make_tet_clusters(tets, kClusterSize)};
}

}  // namespace tacipc
