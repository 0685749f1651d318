// How sharply a rigid surface bends at its edges and corners.
#pragma once

#include <vector>

#include "stages/gel/press/contact/surface.h"

namespace tacipc {

/// Sharpness of every edge: s = 1 − cos θ, at most 1, with θ the angle between the normals of its two triangles, where
/// the surface bends outwards; 0 where it is flat or bends inwards (nothing flat is touched there first), 1 where not
/// exactly two triangles meet. A rounding of radius R cut into pieces of length l has s ≈ l²/(2R²), a cube's edge 1.
/// \param positions of all vertices the surface counts by
/// \return a value per edge of `surface.edges`
/// \pre triangles are counter-clockwise seen from outside
std::vector<double> edge_sharpness(const Surface& surface, const Positions& positions);

/// Position of an edge in `surface.edges`.
/// \pre the surface has it
std::size_t index_of_edge(const Surface& surface, int a, int b);

}  // namespace tacipc
