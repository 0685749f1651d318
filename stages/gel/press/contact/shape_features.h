// Corners and creases of rigid bodies: what is left of a surface if its flat faces could be cut into any triangles.
#pragma once

#include <array>
#include <vector>

#include "stages/gel/press/contact/surface.h"

namespace tacipc {

/// Triangles form a flat face where their corners are within kFlat times the longest edge of its plane, and edges a
/// straight crease where their directions agree as well: more than coordinates in single precision deviate, and far
/// less than a barrier reaches.
inline constexpr double kFlat = 1e-5;

struct ShapeFeatures {
  /// Per vertex: a crease ends or bends here. Vertices inside of flat faces and straight creases are none.
  std::vector<char> is_corner;
  std::vector<char> on_rim;   // per vertex: on an edge of a face
  std::vector<char> is_flat;  // per edge of the surface: inside of a flat face
  /// Per edge between two faces, the two corners at the ends of its straight crease, lower first; no meaning for
  /// others.
  std::vector<std::array<int, 2>> crease;
};

ShapeFeatures shape_features(const Surface& surface, const Positions& positions);

}  // namespace tacipc
