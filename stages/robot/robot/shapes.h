// The geoms of a model as triangles, for pictures.
#pragma once

#include "common/mesh/triangle_mesh.h"
#include "stages/robot/robot/mjcf_model.h"

namespace tacipc {

/// All geoms of a body in its own frame: primitives in facets, meshes as they are. Planes and height fields, and geoms
/// of groups that MuJoCo's viewer hides (3 and above), have none.
TriangleMesh shape_of_body(const mjModel& model, int body);

}  // namespace tacipc
