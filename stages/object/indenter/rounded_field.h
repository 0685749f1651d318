// Heights on a grid, rounded as a print rounds them.
#pragma once

#include "common/mesh/height_field.h"

namespace tacipc {

/// Morphological opening by a ball (erosion, then dilation of the height field): what a ball of this radius reaches
/// from inside. Convex edges get this radius, flat faces and concave edges stay; details thinner than the ball vanish.
HeightField opened(const HeightField& field, double radius_m);

/// The mesh's highest points, opened by a ball, on a grid of `spacing_m` centred on its box. The opening is done on a
/// grid of at least 24 steps to the radius, which the spacing is a multiple of: a wall counts as standing between two
/// grid points, so on a grid as coarse as the mesh wanted, edges would be off by up to its spacing. They are off by a
/// 24th of the radius at most.
HeightField rounded(const TriangleMesh& mesh, double radius_m, double spacing_m, double margin_m);

/// Closed mesh: the field, cut off `relief_m` below its highest point, walls around, a flat floor as far down again.
/// \pre at least 2 × 2 points
TriangleMesh solid(const HeightField& field, double relief_m);

}  // namespace tacipc
