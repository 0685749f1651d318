// Broad phase of one gel or several with themselves and each other.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "stages/gel/press/contact/body_frame.h"
#include "stages/gel/press/contact/self_search.h"

namespace tacipc {

/// Finds pairs of two primitives of the gel, or of gels, that share no vertex. Each of several gels is searched in a
/// frame that goes along with its mount, where it hardly moves and its front looks up (SelfSearch counts on both), and
/// a body without a mount in one that goes along with itself (BodyFrame); two of them against each other only where the
/// boxes around them come near.
class GelsSearch {
 public:
  explicit GelsSearch(const ContactMesh& mesh);

  /// As for SelfSearch; of two gels every pair that comes within `within_m`.
  void pairs(const Positions& x, const Positions& p, double within_m, std::vector<ContactPair>& out);
  void around(const std::vector<char>& wanted, const std::vector<double>& reach_m, const Positions& x, double within_m,
              std::vector<ContactPair>& out);

  /// Pairs of different gels within a distance of each other from x to x + p, and some more.
  void across(const Positions& x, const Positions& p, double within_m, std::vector<ContactPair>& out) const;

  void forget();
  /// Rotations of the mounts' frames from now on, one per part; of a part without a mount any.
  void turn(const std::vector<Matrix3>& world_from_gel) { turns_ = world_from_gel; }
  int num_searches() const;

 private:
  /// The gel's rows of x, and of p, in its frame.
  Positions places(std::size_t gel, const Positions& x) const;
  Positions displacements(std::size_t gel, const Positions& p) const;

  const ContactMesh& mesh_;
  std::vector<std::unique_ptr<SelfSearch>> each_;
  std::vector<Surface> surfaces_;  // of several gels, by vertices of the whole
  std::vector<Matrix3> turns_;
  std::vector<BodyFrame> frames_;  // of bodies without a mount, from the end of the last call of pairs()
};

}  // namespace tacipc
