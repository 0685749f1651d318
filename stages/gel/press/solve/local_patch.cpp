#include "stages/gel/press/solve/local_patch.h"

#include <algorithm>

#include "stages/gel/press/energy/averaged_elasticity.h"
#include "stages/gel/press/energy/elasticity.h"
#include "stages/gel/press/energy/inertia.h"
#include "stages/gel/press/energy/joined_term.h"
#include "stages/gel/press/energy/restricted_term.h"
#include "stages/gel/press/energy/viscous_memory.h"

namespace tacipc {
namespace {

bool any_moves(const std::vector<bool>& moves, const auto& vertices) {
  return std::any_of(vertices.begin(), vertices.end(), [&](int v) { return moves[static_cast<std::size_t>(v)]; });
}

}  // namespace

LocalPatch grow_patch(const std::vector<int>& seeds, int rings, const Tetrahedra& tets, const FreeVertices& all_free) {
  std::vector<bool> moves(all_free.free_of_vertex.size(), false);
  for (const int v : seeds) moves[v] = true;
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<bool> grown = moves;
    for (Eigen::Index t = 0; t < tets.rows(); ++t) {
      if (any_moves(moves, tets.row(t)))
        for (int k = 0; k < 4; ++k) grown[tets(t, k)] = true;
    }
    moves = std::move(grown);
  }
  for (std::size_t v = 0; v < moves.size(); ++v) moves[v] = moves[v] && all_free.free_of_vertex[v] >= 0;

  std::vector<int> inside;
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    if (any_moves(moves, tets.row(t))) inside.push_back(static_cast<int>(t));
  }
  Tetrahedra own(static_cast<Eigen::Index>(inside.size()), 4);
  for (std::size_t i = 0; i < inside.size(); ++i) own.row(static_cast<Eigen::Index>(i)) = tets.row(inside[i]);
  std::vector<bool> held = moves;
  held.flip();
  FreeVertices free(all_free.vertex_of_free, held);  // in the order of the whole
  free.num_control_points = all_free.num_control_points;
  return {std::move(moves), std::move(free), std::move(own)};
}

std::shared_ptr<const EnergyTerm> restricted(const std::shared_ptr<const EnergyTerm>& term,
                                             const std::vector<bool>& moves) {
  if (!term) return nullptr;
  if (const auto* joined = dynamic_cast<const JoinedTerm*>(term.get())) {
    std::vector<std::shared_ptr<const EnergyTerm>> parts;
    for (const auto& part : joined->parts()) parts.push_back(restricted(part, moves));
    return std::make_shared<JoinedTerm>(std::move(parts));
  }
  std::vector<int> stencils;
  for (int i = 0; i < term->num_stencils(); ++i) {
    if (any_moves(moves, term->stencil(i))) stencils.push_back(i);
  }
  if (const auto* elasticity = dynamic_cast<const Elasticity*>(term.get()))
    return std::make_shared<Elasticity>(*elasticity, stencils);
  if (const auto* elasticity = dynamic_cast<const AveragedElasticity*>(term.get()))
    return std::make_shared<AveragedElasticity>(*elasticity, stencils);
  if (const auto* memory = dynamic_cast<const ViscousMemory*>(term.get()))
    return std::make_shared<ViscousMemory>(*memory, stencils);
  if (const auto* inertia = dynamic_cast<const Inertia*>(term.get()))
    return std::make_shared<Inertia>(*inertia, stencils);
  return std::make_shared<RestrictedTerm>(term, std::move(stencils));
}

std::vector<ContactPair> with_patch(std::vector<ContactPair> before, const std::vector<bool>& moves,
                                    const std::vector<ContactPair>& own) {
  std::erase_if(before, [&](const ContactPair& pair) { return any_moves(moves, pair.vertices); });
  before.insert(before.end(), own.begin(), own.end());
  return before;
}

}  // namespace tacipc
