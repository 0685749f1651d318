// Broad phase: pairs of primitives that may come near each other, at given positions or during a step.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "stages/gel/press/contact/gels_search.h"
#include "stages/gel/press/contact/object_search.h"
#include "stages/gel/press/contact/surface_pairs.h"

namespace tacipc {

/// Finds gel–object pairs, gel–gel pairs (never two primitives that share a vertex) and object–object pairs.
class ContactSearch {
 public:
  /// \pre the mesh outlives the search and keeps its address
  explicit ContactSearch(const ContactMesh& mesh) : mesh_(mesh), with_itself_(mesh), held_(mesh.objects.size(), false) {
    const auto bodies = std::min(held_.size(), static_cast<std::size_t>(mesh.num_control_points / 4));
    std::fill(held_.begin() + static_cast<std::ptrdiff_t>(bodies), held_.end(), true);
    for (const ObjectPart& object : mesh.objects) with_object_.push_back(std::make_unique<ObjectSearch>(mesh, object));
  }

  /// Every pair that comes within `within_m` while the vertices move straight from `x` to `x + p`, or a superset. Pairs
  /// within a gel count up to half of their distance at rest at most. The pairs and their order depend only on the
  /// arguments since forget().
  std::vector<ContactPair> pairs(const Positions& x, const Positions& p, double within_m) {
    std::vector<ContactPair> found = object_pairs(x, p, within_m);
    with_itself_.pairs(x, p, within_m, found);
    return found;
  }

  /// Pairs with at least one object; `within_m` may be any distance.
  std::vector<ContactPair> object_pairs(const Positions& x, const Positions& p, double within_m) {
    std::vector<ContactPair> found;
    for (const auto& search : with_object_) search->pairs(x, p, within_m, found);
    for (std::size_t a = 0; a < mesh_.objects.size(); ++a) {
      for (std::size_t b = a + 1; b < mesh_.objects.size(); ++b) {
        if (!held_[a] || !held_[b])
          pairs_between(mesh_.objects[a].surface, mesh_.objects[b].surface, x, p, within_m, found);
      }
    }
    return found;
  }

  /// Pairs of two different bodies; `within_m` may be any distance.
  std::vector<ContactPair> pairs_of_bodies(const Positions& x, const Positions& p, double within_m) {
    std::vector<ContactPair> found = object_pairs(x, p, within_m);
    with_itself_.across(x, p, within_m, found);
    return found;
  }

  /// Every pair with a `wanted` gel vertex that comes within `within_m` while each gel vertex stays within its
  /// `reach_m` of its position in `x`, or a superset.
  /// \param wanted, reach_m one number per vertex
  /// \pre wanted vertices have a reach above zero; objects are where the last call of pairs() had them
  std::vector<ContactPair> pairs_around(const std::vector<char>& wanted, const std::vector<double>& reach_m,
                                        const Positions& x, double within_m) {
    std::vector<ContactPair> found;
    for (const auto& search : with_object_) search->around(wanted, reach_m, x, within_m, found);
    with_itself_.around(wanted, reach_m, x, within_m, found);
    return found;
  }

  /// Discards earlier results, because pairs found in a time step must not depend on earlier steps.
  void forget() {
    for (const auto& search : with_object_) search->forget();
    with_itself_.forget();
  }

  /// Sets which objects are held: two held objects are not searched against each other. Initially these are the objects
  /// without control points.
  void hold(std::vector<bool> held) { held_ = std::move(held); }

  const ObjectSearch& with_object(std::size_t object = 0) const { return *with_object_[object]; }
  const GelsSearch& with_itself() const { return with_itself_; }
  /// Sets the rotations of several gels, in the order of ContactMesh::gels.
  void turn_gels(const std::vector<Matrix3>& world_from_gel) { with_itself_.turn(world_from_gel); }

 private:
  const ContactMesh& mesh_;
  std::vector<std::unique_ptr<ObjectSearch>> with_object_;
  GelsSearch with_itself_;
  std::vector<bool> held_;
};

}  // namespace tacipc
