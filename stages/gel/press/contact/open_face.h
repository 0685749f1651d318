// A proof that a flat face of the gel is nowhere near itself, without looking at any pair.
#pragma once

#include <Eigen/Geometry>
#include <array>
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
///
/// Where it fails in some triangles, two places can only come nearer than c times their distance at rest if the line
/// between them at rest crosses one of those; and nearer than d only if they are no farther apart at rest than d and
/// both their ways sideways together. So both are that near to one of those triangles: at risk.
class OpenFace {
 public:
  explicit OpenFace(const ContactMesh& mesh);

  /// Whether a vertex belongs to the face; none does if there is no such face.
  bool has(int vertex) const { return on_face_[static_cast<std::size_t>(vertex)]; }

  /// Whether from x to x + p no two parts of the face come as near as half of their distance at rest.
  bool stays_open(const Positions& x, const Positions& p) const { return at_risk(x, p, 0.0).none(); }

  /// A set of places on the face at rest, by squares.
  class Places {
   public:
    bool none() const { return in_.empty(); }
    /// Whether any of them is in a square that the box around these vertices at rest touches.
    template <std::size_t Vertices>
    bool near(const std::array<int, Vertices>& vertices) const;
    /// Whether the other set has all of them.
    bool within(const Places& other) const;

   private:
    friend class OpenFace;
    const OpenFace* face_ = nullptr;
    std::vector<char> in_;  // square by square, row by row; empty if there is none
  };
  /// A set with every place of the face that may come nearer than `d_hat_m` to another, or than half of their distance
  /// at rest, from x to x + p.
  Places at_risk(const Positions& x, const Positions& p, double d_hat_m) const;

 private:
  static constexpr int kSquares = 256;  // along each side
  /// First and last square along x, and along y, that a box touches.
  std::array<int, 4> squares(const Eigen::AlignedBox2d& box) const;
  /// Longest horizontal way of a vertex of the face from its place at rest, at x and at x + p, m.
  double farthest_sideways(const Positions& x, const Positions& p) const;
  struct Triangle {
    std::array<int, 3> vertices;
    Eigen::Matrix2d inverse_edges;  // of the edges from vertex 0 at rest
  };
  const ContactMesh& mesh_;
  std::vector<bool> on_face_;
  std::vector<int> vertices_;  // of the face
  std::vector<Triangle> triangles_;
  Eigen::AlignedBox2d outline_;
};

template <std::size_t Vertices>
bool OpenFace::Places::near(const std::array<int, Vertices>& vertices) const {
  if (none()) return false;
  Eigen::AlignedBox2d box;
  for (const int v : vertices) box.extend(Eigen::Vector2d(face_->mesh_.rest_positions.row(v).head<2>()));
  const auto [left, right, low, high] = face_->squares(box);
  for (int j = low; j <= high; ++j) {
    for (int i = left; i <= right; ++i)
      if (in_[static_cast<std::size_t>(j * kSquares + i)]) return true;
  }
  return false;
}

}  // namespace tacipc
