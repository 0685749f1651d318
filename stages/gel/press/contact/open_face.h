// A proof that a flat face of the gel is nowhere near itself, without looking at any pair.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
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
/// the difference u of their ways sideways. So both are that near to one of those triangles: at risk. u is at most what
/// two ways on the face differ by; so they are that near, and u is at most what two ways within that differ by, and so
/// on.
class OpenFace {
 public:
  explicit OpenFace(const ContactMesh& mesh);

  /// Whether a vertex belongs to the face; none does if there is no such face.
  bool has(int vertex) const { return on_face_[static_cast<std::size_t>(vertex)]; }

  /// Squares that a box on the face touches: the first and the last along x, and along y.
  struct Squares {
    std::uint8_t left, right, low, high;
  };
  /// Those of the box around some vertices at rest.
  template <std::size_t Vertices>
  Squares squares_around(const std::array<int, Vertices>& vertices) const {
    Eigen::AlignedBox2d box;
    for (const int v : vertices) box.extend(Eigen::Vector2d(mesh_.rest_positions.row(v).head<2>()));
    return squares(box);
  }

  /// A set of places on the face at rest, by squares.
  class Places {
   public:
    bool none() const { return in_.empty(); }
    /// Whether any of them is in one of these squares.
    bool near(const Squares& squares) const;
    /// Whether the other set has all of them.
    bool within(const Places& other) const;

   private:
    friend class OpenFace;
    std::vector<char> in_;  // square by square, row by row; empty if there is none
  };
  /// A set with every place of the face that may come nearer than `within_m` to another, or than half of their distance
  /// at rest, from x to x + p.
  Places at_risk(const Positions& x, const Positions& p, double within_m) const;

 private:
  static constexpr int kSquares = 256;  // along each side
  Squares squares(const Eigen::AlignedBox2d& box) const;
  struct Triangle {
    std::array<int, 3> vertices;
    Eigen::Matrix2d inverse_edges;  // of the edges from vertex 0 at rest
    Squares squares;                // at rest
  };
  class Ways;
  const ContactMesh& mesh_;
  std::vector<bool> on_face_;
  std::vector<Triangle> triangles_;
  Eigen::AlignedBox2d outline_;
};

inline bool OpenFace::Places::near(const Squares& squares) const {
  if (none()) return false;
  for (int j = squares.low; j <= squares.high; ++j) {
    for (int i = squares.left; i <= squares.right; ++i)
      if (in_[static_cast<std::size_t>(j * kSquares + i)]) return true;
  }
  return false;
}

}  // namespace tacipc
