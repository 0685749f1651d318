// Converts the geoms of a MuJoCo model to triangles, for pictures.
#pragma once

#include "common/mesh/triangle_mesh.h"
#include "stages/robot/robot/mjcf_model.h"

namespace tacipc {

/// Returns all geoms of a body as one mesh in the body's frame, m: facets for primitives, meshes unchanged. Left out:
/// planes, height fields, and geoms of groups that MuJoCo's viewer hides (3 and above).
TriangleMesh shape_of_body(const mjModel& model, int body);

}  // namespace tacipc
