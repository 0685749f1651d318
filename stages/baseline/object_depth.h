// What the sensor's camera would see of the object through a gel that is not there.
#pragma once

#include <string>

#include "common/sensor.h"
#include "common/triangle_mesh.h"
#include "stages/baseline/raster.h"

namespace tacipc {

/// Depth along the camera's axis (m) of the first surface on the straight ray through each pixel's centre, of the mesh
/// placed by `gel_from_object`; NaN where nothing is. A ray through an edge or a corner meets the triangles that share
/// it. \throw DataError, naming `name`, if the object reaches as far as the camera's plane.
Raster object_depth(const TriangleMesh& object, const Matrix4& gel_from_object, const Camera& camera,
                    const std::string& name);

/// Depth (m) of the undeformed front on the same rays.
Raster front_depth(const Sensor& sensor);

}  // namespace tacipc
