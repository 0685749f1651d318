// Gap between a gel and the surface in front of it.
#pragma once

#include "common/base/types.h"
#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Returns the smallest z, in the gel's frame S, of the surface within |x|, |y| ≤ radius, m. Negative: the surface is
/// behind the undeformed front; +∞: no surface there. Only facets that face the gel, more steeply than 10°, count, and
/// nothing farther than the radius behind the front.
double gap_before(const TriangleMesh& surface, const Matrix4& gel_from_surface, double radius_m);

}  // namespace tacipc
