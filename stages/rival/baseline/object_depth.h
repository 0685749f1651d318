// Views the object through the sensor's camera without a gel.
#pragma once

#include <string>
#include <vector>

#include "common/mesh/triangle_mesh.h"
#include "common/sensor/camera_model.h"
#include "common/sensor/sensor.h"
#include "stages/rival/baseline/raster.h"

namespace tacipc {

/// Lines of sight to the object: the camera's rays, refracted at the sensor's layers as everywhere else; the same rays
/// unrefracted, as in simulators without a window; or parallel to the z axis, for methods without a camera.
enum class ObjectRays { refracted, straight, parallel };

/// Depth along the camera's axis (m), NaN where no object is visible, and outward unit normals interpolated between
/// vertices; no normals if they were not requested.
struct SeenObject {
  Raster depth;
  std::vector<Vector3> normal = {};
  double pressed_m = 0.0;  // depth of a mesh's deepest vertex in the gel (z < 0), visible or not
};

/// Camera with one ray through each pixel's centre, made once for many poses.
class ObjectCamera {
 public:
  /// \throw DataError if a ray misses the front
  ObjectCamera(const Sensor& sensor, ObjectRays rays);

  /// First surface on each ray of the mesh placed by `gel_from_object`. A ray through an edge or a corner hits the
  /// triangles that share it.
  /// \param vertex_normals normals of the mesh in its own frame, or empty
  /// \param name name of the object in messages
  /// \throw DataError if the object reaches the camera or, if rays are refracted, the layers behind the gel
  SeenObject see(const TriangleMesh& object, const Positions& vertex_normals, const Matrix4& gel_from_object,
                 const std::string& name) const;
  /// Depth (m) of the undeformed front on the same rays; NaN where a ray misses a dome.
  Raster front() const;

 private:
  struct Line {
    Vector3 origin, direction;
  };
  const Line& line(int x, int y) const { return lines_[static_cast<std::size_t>(y) * camera_.width_px + x]; }

  Camera camera_;
  GelShape gel_;
  CameraModel model_;
  ObjectRays rays_;
  double nearest_z_m_;
  std::vector<Line> lines_;
};

}  // namespace tacipc
