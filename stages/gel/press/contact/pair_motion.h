// Proofs, safe against rounding, that a moving point–triangle or edge–edge pair stays apart during an interval of time.
#pragma once

#include <optional>

#include "stages/gel/press/contact/contact_pair.h"

namespace tacipc {

/// Four vertices on straight paths xᵢ + t dᵢ, 0 ≤ t ≤ 1, seen from vertex 0: what all four share (the mean
/// displacement, the distance to the origin) cancels in the relative paths qᵢ(t).
///
/// Both certificates hold for the exact paths and for all paths that differ from them by the rounding of dᵢ = end −
/// start and of xᵢ + t dᵢ to doubles. With u = 2⁻⁵³, S ≥ |qᵢ(0)| + |qᵢ(1) − qᵢ(0)| and M ≥ |xᵢ| + |dᵢ| in each
/// coordinate: a difference of two vertices is computed within 8 u S, and those other paths move it by at most 8 u M.
class PairMotion {
 public:
  PairMotion(ContactPair::Kind kind, const FourPoints& x, const FourPoints& displacement);

  /// Relative positions at time t, vertex 0 at the origin.
  FourPoints at(double t) const;
  ClosestFeature closest(double t) const;

  /// Unit direction from the second body to the first where they are closest; empty where they touch or numbers
  /// overflow.
  std::optional<Vector3> direction(const ClosestFeature& feature) const;

  /// Smallest computed n·(first − second) over all vertex pairs at time t: a lower bound of the distance, up to
  /// gap_error_.
  double gap(double t, const Vector3& n) const;
  /// Time up to which the gap along n stays above `separation` by twice the error; `from` if there is none.
  double gap_exit(double from, const Vector3& n, double separation) const;

  /// True only if the distance is above `separation` on all of [from, to], shown by a plane whose normal goes linearly
  /// from n_from to n_to. Each vertex pair's gap is then quadratic in time; its Bernstein coefficients bound it from
  /// below.
  bool plane_separates(double from, double to, const Vector3& n_from, const Vector3& n_to, double separation) const;

  /// The same, shown by the volume of the four vertices, a cubic, against the area (of the triangle, or spanned by the
  /// edges), a quadratic: distance ≥ volume / area. This one sees sliding and rolling at tiny gaps.
  bool volume_separates(double from, double to, double separation) const;

 private:
  ContactPair::Kind kind_;
  FourPoints start_;   // qᵢ(0)
  FourPoints change_;  // qᵢ(1) − qᵢ(0)
  double gap_error_;
  double difference_error_;  // length of the error of a difference of two vertices
};

}  // namespace tacipc
