// The object as the sensor's camera sees it without a gel.
#pragma once

#include <string>
#include <vector>

#include "common/mesh/triangle_mesh.h"
#include "common/sensor/camera_model.h"
#include "common/sensor/sensor.h"
#include "stages/rival/baseline/raster.h"

namespace tacipc {

/// Along what an object is seen: the camera's rays, bent at the sensor's layers as everywhere else; the same unbent, as
/// simulators have it that know no window; or straight down the z axis, where a method has no camera.
enum class ObjectRays { refracted, straight, parallel };

/// Depth along the camera's axis (m), NaN where nothing is, and unit normals out of the object, interpolated between
/// its vertices; none if they were not asked for.
struct SeenObject {
  Raster depth;
  std::vector<Vector3> normal = {};
  double pressed_m = 0.0;  // of a mesh: how far its deepest vertex is in the gel (z < 0), in view or not
};

/// One ray through each pixel's centre, made once for many poses.
class ObjectCamera {
 public:
  /// \throw DataError if a pixel looks away from the front
  ObjectCamera(const Sensor& sensor, ObjectRays rays);

  /// The first surface on each ray of the mesh placed by `gel_from_object`. A ray through an edge or a corner meets the
  /// triangles that share it. `vertex_normals`: of the mesh in its own frame, or none. \throw DataError, naming `name`,
  /// if the object reaches as far as the camera, or as the layers behind the gel where rays bend.
  SeenObject see(const TriangleMesh& object, const Positions& vertex_normals, const Matrix4& gel_from_object,
                 const std::string& name) const;
  /// Depth (m) of the undeformed front on the same rays; NaN where a dome ends before.
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
