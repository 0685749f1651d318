// Depth of the object as seen by the sensor's camera without a gel.
#pragma once

#include <string>

#include "common/mesh/triangle_mesh.h"
#include "common/sensor/sensor.h"
#include "stages/rival/baseline/raster.h"

namespace tacipc {

/// Depth along the camera's axis (m) of the first surface on the straight ray through each pixel's centre, of the mesh
/// placed by `gel_from_object`; NaN where nothing is. A ray through an edge or a corner meets the triangles that share
/// it. \throw DataError, naming `name`, if the object reaches as far as the camera's plane.
Raster object_depth(const TriangleMesh& object, const Matrix4& gel_from_object, const Camera& camera,
                    const std::string& name);

/// Depth (m) of the undeformed front on the same rays.
Raster front_depth(const Sensor& sensor);

}  // namespace tacipc
