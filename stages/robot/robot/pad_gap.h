// How far something is in front of a gel.
#pragma once

#include "common/base/types.h"
#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// The smallest z of the surface in the gel's frame S, of what lies in |x|, |y| ≤ radius and looks at the gel, more
/// steeply than 10°: negative behind the undeformed front; +∞ where nothing is there. What is more than the radius
/// behind the front is not in front of it.
double gap_before(const TriangleMesh& surface, const Matrix4& gel_from_surface, double radius_m);

}  // namespace tacipc
