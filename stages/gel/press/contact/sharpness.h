// Sharpness of the edges of a surface.
#pragma once

#include <vector>

#include "stages/gel/press/contact/surface.h"

namespace tacipc {

/// Sharpness of every edge. Where the surface bends outwards, s = min(1 − cos θ, 1) with θ the angle between the
/// normals of the edge's two triangles. s = 0 if the surface is flat or bends inwards, because nothing flat touches
/// there first, and 1 unless exactly two triangles meet. A rounding of radius R cut into pieces of length l has s ≈
/// l²/(2R²), a cube's edge has 1.
/// \param positions all vertices that the surface's indices refer to
/// \return one value per edge of `surface.edges`
/// \pre triangles are counter-clockwise seen from outside
std::vector<double> edge_sharpness(const Surface& surface, const Positions& positions);

/// Index of an edge in `surface.edges`. \pre the surface has this edge
std::size_t index_of_edge(const Surface& surface, int a, int b);

}  // namespace tacipc
