// Broad phase: which pairs of primitives may come near each other, now or during a step.
#pragma once

#include <vector>

#include "stages/press/contact/object_search.h"
#include "stages/press/contact/self_search.h"

namespace tacipc {

/// Finds pairs gel–object and gel–gel (never two primitives that share a vertex).
class ContactSearch {
 public:
  explicit ContactSearch(const ContactMesh& mesh) : with_object_(mesh), with_itself_(mesh) {}

  /// Every pair that comes within `radius_m` while the vertices move straight from `x` to `x + p`, of the gel with
  /// itself within min(radius, half the distance at rest), and some more; what and in which order depends on the
  /// arguments since forget() only.
  std::vector<ContactPair> pairs(const Positions& x, const Positions& p, double radius_m) {
    std::vector<ContactPair> found = object_pairs(x, p, radius_m);
    with_itself_.pairs(x, p, radius_m, found);
    return found;
  }

  /// Those of gel and object alone.
  std::vector<ContactPair> object_pairs(const Positions& x, const Positions& p, double radius_m) {
    std::vector<ContactPair> found;
    with_object_.pairs(x, p, radius_m, found);
    return found;
  }

  /// Every pair with a vertex that `moves` (one flag per vertex) that comes as near while each of those vertices stays
  /// within `reach_m` of its place in each coordinate, and some more. \pre all are where the last call of pairs() saw
  /// them come by; the object stands still
  std::vector<ContactPair> pairs_around(const std::vector<bool>& moves, const Positions& x, double radius_m,
                                        double reach_m) const {
    std::vector<ContactPair> found;
    with_object_.around(moves, x, radius_m + reach_m, found);
    with_itself_.around(moves, x, radius_m, reach_m, found);
    return found;
  }

  /// The next call searches, whatever is known: what is found in a time step must not hang on steps before.
  void forget() {
    with_object_.forget();
    with_itself_.forget();
  }

  const ObjectSearch& with_object() const { return with_object_; }
  const SelfSearch& with_itself() const { return with_itself_; }

 private:
  ObjectSearch with_object_;
  SelfSearch with_itself_;
};

}  // namespace tacipc
