// Bounds where a flat face of the gel can come near itself, without looking at pairs.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "stages/gel/press/contact/contact_mesh.h"

namespace tacipc {

/// The gel's highest face at rest, if that is flat (normal z) and has a convex outline; else no face.
///
/// Let φ: R² → R² map positions on the face at rest to their current positions, seen along z; φ is linear in each
/// triangle. Suppose that in every triangle the smaller eigenvalue of the symmetric part of ∇φ is at least c. Then any
/// two points a and b satisfy
///   |φ(a) − φ(b)| |a − b| ≥ (φ(a) − φ(b)) · (a − b) = ∫ (a − b)ᵀ ∇φ (a − b) ≥ c |a − b|².
/// The integral is along the straight line between them, which lies in the face because its outline is convex. So no
/// two points come nearer than c times their distance at rest. The condition is convex in the positions: if it holds at
/// both ends of straight paths, it holds in between.
///
/// If the condition fails in some triangles, two points can come nearer than c times their distance at rest only if the
/// line between them at rest crosses such a triangle. They can come nearer than d only if their distance at rest is at
/// most d + u, where u is the difference of their sideways displacements. So both points lie within d + u of a failing
/// triangle; such points are "at risk". A first bound of u is the largest difference of displacements on the whole
/// face. It limits the region at risk; the largest difference within that region is a smaller bound, and so on.
class OpenFace {
 public:
  explicit OpenFace(const ContactMesh& mesh);

  /// Whether a vertex belongs to the face; always false if there is no such face.
  bool has(int vertex) const { return on_face_[static_cast<std::size_t>(vertex)]; }

  /// Range of grid squares that a box on the face touches: first and last along x, first and last along y.
  struct Squares {
    std::uint8_t left, right, low, high;
  };
  /// Squares of the box around these vertices at rest.
  template <std::size_t Vertices>
  Squares squares_around(const std::array<int, Vertices>& vertices) const {
    Eigen::AlignedBox2d box;
    for (const int v : vertices) box.extend(Eigen::Vector2d(mesh_.rest_positions.row(v).head<2>()));
    return squares(box);
  }

  /// A set of points on the face at rest, stored by grid squares.
  class Places {
   public:
    bool none() const { return in_.empty(); }
    /// Whether any point of the set is in one of these squares.
    bool near(const Squares& squares) const;
    /// Whether the other set contains this one.
    bool within(const Places& other) const;

   private:
    friend class OpenFace;
    std::vector<char> in_;  // square by square, row by row; empty if the set is empty
  };
  /// Set of all points of the face that may come nearer to another point than `within_m`, or than half of their
  /// distance at rest, between x and x + p. The set may contain more.
  Places at_risk(const Positions& x, const Positions& p, double within_m) const;

 private:
  static constexpr int kSquares = 256;  // number of squares along each side
  Squares squares(const Eigen::AlignedBox2d& box) const;
  struct Triangle {
    std::array<int, 3> vertices;
    Eigen::Matrix2d inverse_edges;  // inverse of the matrix of the two edges from vertex 0 at rest
    Squares squares;                // squares of the triangle at rest
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
