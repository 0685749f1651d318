// A proof that a flat face of the gel is nowhere near itself, without looking at any pair.
#pragma once

#include <vector>

#include "stages/gel/press/contact/contact_mesh.h"

namespace tacipc {

/// The gel's highest face at rest, if that is flat (normal z) and has a convex outline; else no face.
///
/// Let φ take places on the face at rest to where they are now, seen along z: R² → R², linear in each triangle. If the
/// symmetric part of its gradient is at least c in every triangle (its smaller eigenvalue), then for any two places
///   |φ(a) − φ(b)| |a − b| ≥ (φ(a) − φ(b)) · (a − b) = ∫ (a − b)ᵀ ∇φ (a − b) ≥ c |a − b|²
/// along the straight line between them, which does not leave the face: no two parts come nearer to each other than c
/// times their distance at rest. The condition is convex in the positions: where it holds at both ends of straight
/// paths, it holds in between.
class OpenFace {
 public:
  explicit OpenFace(const ContactMesh& mesh);

  /// Whether a vertex belongs to the face; none does if there is no such face.
  bool has(int vertex) const { return on_face_[static_cast<std::size_t>(vertex)]; }

  /// Whether from x to x + p no two parts of the face come as near as half of their distance at rest.
  bool stays_open(const Positions& x, const Positions& p) const;

 private:
  struct Triangle {
    std::array<int, 3> vertices;
    Eigen::Matrix2d inverse_edges;  // of the edges from vertex 0 at rest
  };
  std::vector<bool> on_face_;
  std::vector<Triangle> triangles_;
};

}  // namespace tacipc
