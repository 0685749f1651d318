// Certificates, safe against rounding, that a moving point–triangle or edge–edge pair stays apart during a time
// interval.
#pragma once

#include <optional>

#include "stages/gel/press/contact/contact_pair.h"

namespace tacipc {

/// Four vertices on straight paths xᵢ + t dᵢ, 0 ≤ t ≤ 1, relative to vertex 0: the mean displacement and the distance
/// to the origin, which all four share, cancel in the relative paths qᵢ(t).
///
/// Both certificates hold for the exact paths, and for all paths that differ from them by rounding dᵢ = end − start and
/// xᵢ + t dᵢ to doubles. With u = 2⁻⁵³, S ≥ |qᵢ(0)| + |qᵢ(1) − qᵢ(0)| and M ≥ |xᵢ| + |dᵢ| in each coordinate: a
/// difference of two vertices is computed within 8 u S, and rounding of the paths changes it by at most 8 u M.
class PairMotion {
 public:
  PairMotion(ContactPair::Kind kind, const FourPoints& x, const FourPoints& displacement);

  /// Relative positions at time t, vertex 0 at the origin.
  FourPoints at(double t) const;
  /// Closest feature at time t.
  ClosestFeature closest(double t) const;

  /// Unit direction from the second body to the first at their closest points; empty if they touch or numbers overflow.
  std::optional<Vector3> direction(const ClosestFeature& feature) const;

  /// Smallest computed n·(first − second) over all vertex pairs at time t: a lower bound of the distance within
  /// gap_error_.
  double gap(double t, const Vector3& n) const;
  /// Time up to which the gap along n stays above `separation` by twice the error; `from` if there is none.
  double gap_exit(double from, const Vector3& n, double separation) const;

  /// Certificate by a plane whose normal changes linearly from n_from to n_to. True only if the distance is above
  /// `separation` on all of [from, to]. Each vertex pair's gap is then quadratic in time; its Bernstein coefficients
  /// bound it from below.
  bool plane_separates(double from, double to, const Vector3& n_from, const Vector3& n_to, double separation) const;

  /// Certificate by the volume of the four vertices, a cubic, over the area of the triangle or of the parallelogram of
  /// the edges, a quadratic: distance ≥ volume / area. It succeeds for sliding and rolling at tiny gaps.
  bool volume_separates(double from, double to, double separation) const;

 private:
  ContactPair::Kind kind_;
  FourPoints start_;   // qᵢ(0)
  FourPoints change_;  // qᵢ(1) − qᵢ(0)
  double gap_error_;
  double difference_error_;  // error bound of the difference of two vertices
};

}  // namespace tacipc
