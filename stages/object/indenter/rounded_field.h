// Height field on a grid, with edges rounded as a print rounds them.
#pragma once

#include "common/mesh/height_field.h"

namespace tacipc {

/// Morphological opening by a ball (erosion, then dilation of the height field): the region that a ball of this radius
/// reaches from inside. Convex edges get this radius, flat faces and concave edges stay; details thinner than the ball
/// vanish.
HeightField opened(const HeightField& field, double radius_m);

/// Highest points of the mesh, opened by a ball, on a grid of `spacing_m` centred on its box. The opening uses a finer
/// grid of at least 24 steps per radius, of which the spacing is a multiple. A wall counts as standing between two grid
/// points, so edges are off by at most one step of that grid, a 24th of the radius.
HeightField rounded(const TriangleMesh& mesh, double radius_m, double spacing_m, double margin_m);

/// Closed mesh of the field, cut off `relief_m` below its highest point, with walls around it and a flat floor another
/// `relief_m` lower.
/// \pre at least 2 × 2 points
TriangleMesh solid(const HeightField& field, double relief_m);

}  // namespace tacipc
