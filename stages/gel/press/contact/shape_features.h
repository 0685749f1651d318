// Corners and creases of rigid bodies: features of the shape that do not depend on how its flat faces are triangulated.
#pragma once

#include <array>
#include <vector>

#include "stages/gel/press/contact/surface.h"

namespace tacipc {

/// Relative tolerance of flatness. Triangles form a flat face if their corners are within kFlat times the longest edge
/// of its plane; edges form a straight crease if their directions agree as well. The tolerance exceeds the rounding of
/// coordinates in single precision and is far below the range of a barrier.
inline constexpr double kFlat = 1e-5;

/// Features of a surface by vertex and by edge.
struct ShapeFeatures {
  /// Per vertex: whether a crease ends or bends here. False inside of flat faces and straight creases.
  std::vector<char> is_corner;
  std::vector<char> on_rim;   // per vertex: whether it is on an edge of a face
  std::vector<char> is_flat;  // per edge of the surface: whether it is inside a flat face
  /// Per edge between two faces: the two corners at the ends of its straight crease, lower index first. Undefined for
  /// other edges.
  std::vector<std::array<int, 2>> crease;
};

/// Finds the features of a surface at these positions.
ShapeFeatures shape_features(const Surface& surface, const Positions& positions);

}  // namespace tacipc
