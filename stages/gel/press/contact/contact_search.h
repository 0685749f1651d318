// Broad phase: which pairs of primitives may come near each other, now or during a step.
#pragma once

#include <vector>

#include "stages/gel/press/contact/gels_search.h"
#include "stages/gel/press/contact/object_search.h"

namespace tacipc {

/// Finds pairs gel–object and gel–gel (never two primitives that share a vertex).
class ContactSearch {
 public:
  explicit ContactSearch(const ContactMesh& mesh) : with_object_(mesh), with_itself_(mesh) {}

  /// Every pair that comes within d̂ while the vertices move straight from `x` to `x + p`, of the gel with itself within
  /// min(d̂, half the distance at rest), and some more; which and in which order depends only on the arguments since
  /// forget().
  std::vector<ContactPair> pairs(const Positions& x, const Positions& p, double d_hat_m) {
    std::vector<ContactPair> found = object_pairs(x, p, d_hat_m);
    with_itself_.pairs(x, p, d_hat_m, found);
    return found;
  }

  /// Those of gel and object alone, within any distance.
  std::vector<ContactPair> object_pairs(const Positions& x, const Positions& p, double within_m) {
    std::vector<ContactPair> found;
    with_object_.pairs(x, p, within_m, found);
    return found;
  }

  /// Every pair with a vertex that `moves` (one flag per vertex) that comes as near while each of those vertices stays
  /// within `reach_m` of its place in each coordinate, and some more. \pre all are on the paths of the last call of
  /// pairs(); the object stands still
  std::vector<ContactPair> pairs_around(const std::vector<bool>& moves, const Positions& x, double d_hat_m,
                                        double reach_m) const {
    std::vector<ContactPair> found;
    with_object_.around(moves, x, d_hat_m + reach_m, found);
    with_itself_.around(moves, x, d_hat_m, reach_m, found);
    return found;
  }

  /// The next call searches anew: what is found in a time step must not depend on earlier steps.
  void forget() {
    with_object_.forget();
    with_itself_.forget();
  }

  const ObjectSearch& with_object() const { return with_object_; }
  const GelsSearch& with_itself() const { return with_itself_; }
  /// Says how several gels are turned from now on, in the order of ContactMesh::gels.
  void turn_gels(const std::vector<Matrix3>& world_from_gel) { with_itself_.turn(world_from_gel); }

 private:
  ObjectSearch with_object_;
  GelsSearch with_itself_;
};

}  // namespace tacipc
