#include "stages/gel/press/solve/local_patch.h"

#include <algorithm>
#include <numeric>

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

TetsOfVertices::TetsOfVertices(const Tetrahedra& tets, Eigen::Index num_vertices)
    : start_(static_cast<std::size_t>(num_vertices) + 1, 0), tets_(static_cast<std::size_t>(tets.size())) {
  for (const int v : tets.reshaped()) ++start_[static_cast<std::size_t>(v) + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  std::vector<std::size_t> next = start_;
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    for (const int v : tets.row(t)) tets_[next[static_cast<std::size_t>(v)]++] = static_cast<int>(t);
  }
}

LocalPatch grow_patch(const std::vector<int>& seeds, const PatchSize& size, const Tetrahedra& tets,
                      const TetsOfVertices& tets_of, const FreeVertices& all_free) {
  std::vector<bool> moves(all_free.free_of_vertex.size(), false);
  std::vector<int> reached;
  int num_free = 0;
  const auto reach = [&](int v) {
    if (moves[v]) return;
    moves[v] = true;
    reached.push_back(v);
    num_free += all_free.free_of_vertex[v] >= 0;
  };
  for (const int v : seeds) reach(v);
  std::size_t ring_start = 0;
  for (int ring = 0; ring < size.rings || (ring < size.most_rings && num_free < size.fewest_vertices); ++ring) {
    const std::size_t ring_end = reached.size();
    for (; ring_start < ring_end; ++ring_start) {
      for (const int t : tets_of[reached[ring_start]]) {
        for (int k = 0; k < 4; ++k) reach(tets(t, k));
      }
    }
  }
  std::vector<char> is_inside(static_cast<std::size_t>(tets.rows()), 0);
  for (const int v : reached) {
    moves[v] = all_free.free_of_vertex[v] >= 0;
    if (!moves[v]) continue;
    for (const int t : tets_of[v]) is_inside[static_cast<std::size_t>(t)] = 1;
  }
  std::vector<int> inside;
  for (std::size_t t = 0; t < is_inside.size(); ++t) {
    if (is_inside[t]) inside.push_back(static_cast<int>(t));
  }
  Tetrahedra own(static_cast<Eigen::Index>(inside.size()), 4);
  for (std::size_t i = 0; i < inside.size(); ++i) own.row(static_cast<Eigen::Index>(i)) = tets.row(inside[i]);
  std::vector<bool> held = moves;
  held.flip();
  FreeVertices free(all_free.vertex_of_free, held);  // numbering in the order of the whole gel
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
