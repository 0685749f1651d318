// Broad phase of one or several gels with themselves and with each other.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "stages/gel/press/contact/body_frame.h"
#include "stages/gel/press/contact/self_search.h"

namespace tacipc {

/// Finds pairs of two primitives of one gel, or of two gels, that share no vertex. Each of several gels is searched in
/// a frame that moves with its mount: there the gel hardly moves and its front faces up, which SelfSearch relies on. A
/// body without a mount is searched in a frame that moves with the body itself (BodyFrame). Two gels are searched
/// against each other only if the boxes around them come near each other.
class GelsSearch {
 public:
  explicit GelsSearch(const ContactMesh& mesh);

  /// Appends pairs within a gel as SelfSearch does, and between two gels every pair that comes within `within_m`.
  void pairs(const Positions& x, const Positions& p, double within_m, std::vector<ContactPair>& out);
  void around(const std::vector<char>& wanted, const std::vector<double>& reach_m, const Positions& x, double within_m,
              std::vector<ContactPair>& out);

  /// Appends pairs of different gels that come within `within_m` between x and x + p, or a superset.
  void across(const Positions& x, const Positions& p, double within_m, std::vector<ContactPair>& out) const;

  /// Discards earlier results: the next call repeats the search.
  void forget();
  /// Sets the rotations of the mounts' frames, one per part; ignored for a part without a mount.
  void turn(const std::vector<Matrix3>& world_from_gel) { turns_ = world_from_gel; }
  /// Number of calls of SelfSearch::pairs() that had to search, over all gels.
  int num_searches() const;

 private:
  /// Rows of a gel in x, or in p, transformed to its frame.
  Positions places(std::size_t gel, const Positions& x) const;
  Positions displacements(std::size_t gel, const Positions& p) const;

  const ContactMesh& mesh_;
  std::vector<std::unique_ptr<SelfSearch>> each_;
  std::vector<Surface> surfaces_;  // surface of each of several gels, by vertices of the whole mesh
  std::vector<Matrix3> turns_;
  std::vector<BodyFrame> frames_;  // frames of bodies without a mount at the end of the last call of pairs()
};

}  // namespace tacipc
