// Broad phase: which pairs of primitives may come near each other, now or during a step.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "stages/gel/press/contact/gels_search.h"
#include "stages/gel/press/contact/object_search.h"
#include "stages/gel/press/contact/surface_pairs.h"

namespace tacipc {

/// Finds pairs gel–object, gel–gel (never two primitives that share a vertex), and object–object.
class ContactSearch {
 public:
  /// \pre the mesh stays where it is
  explicit ContactSearch(const ContactMesh& mesh) : mesh_(mesh), with_itself_(mesh), held_(mesh.objects.size(), false) {
    const auto bodies = std::min(held_.size(), static_cast<std::size_t>(mesh.num_control_points / 4));
    std::fill(held_.begin() + static_cast<std::ptrdiff_t>(bodies), held_.end(), true);
    for (const ObjectPart& object : mesh.objects) with_object_.push_back(std::make_unique<ObjectSearch>(mesh, object));
  }

  /// Every pair that comes within `within_m` while the vertices move straight from `x` to `x + p`, of the gel with
  /// itself within half the distance at rest at most, and some more; which and in which order depends only on the
  /// arguments since forget().
  std::vector<ContactPair> pairs(const Positions& x, const Positions& p, double within_m) {
    std::vector<ContactPair> found = object_pairs(x, p, within_m);
    with_itself_.pairs(x, p, within_m, found);
    return found;
  }

  /// Those with an object alone, within any distance.
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

  /// Those of two bodies, within any distance.
  std::vector<ContactPair> pairs_of_bodies(const Positions& x, const Positions& p, double within_m) {
    std::vector<ContactPair> found = object_pairs(x, p, within_m);
    with_itself_.across(x, p, within_m, found);
    return found;
  }

  /// Every pair with a `wanted` vertex of the gel that comes as near while each vertex of the gel stays within its
  /// `reach_m` of its place, and some more. (One number of each per vertex.) \pre wanted vertices have a reach above
  /// zero; objects are where the last call of pairs() had them
  std::vector<ContactPair> pairs_around(const std::vector<char>& wanted, const std::vector<double>& reach_m,
                                        const Positions& x, double within_m) {
    std::vector<ContactPair> found;
    for (const auto& search : with_object_) search->around(wanted, reach_m, x, within_m, found);
    with_itself_.around(wanted, reach_m, x, within_m, found);
    return found;
  }

  /// The next call searches anew: what is found in a time step must not depend on earlier steps.
  void forget() {
    for (const auto& search : with_object_) search->forget();
    with_itself_.forget();
  }

  /// Says which objects go where they are told from now on: two of these do not touch each other. Before, it is those
  /// without points to move freely by.
  void hold(std::vector<bool> held) { held_ = std::move(held); }

  const ObjectSearch& with_object(std::size_t object = 0) const { return *with_object_[object]; }
  const GelsSearch& with_itself() const { return with_itself_; }
  /// Says how several gels are turned from now on, in the order of ContactMesh::gels.
  void turn_gels(const std::vector<Matrix3>& world_from_gel) { with_itself_.turn(world_from_gel); }

 private:
  const ContactMesh& mesh_;
  std::vector<std::unique_ptr<ObjectSearch>> with_object_;
  GelsSearch with_itself_;
  std::vector<bool> held_;
};

}  // namespace tacipc
