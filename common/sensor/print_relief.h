// The surface of a printed object as it was made: slopes that its mesh does not have, layers and uneven edges.
#pragma once

#include <filesystem>

#include "common/base/types.h"
#include "common/image/image.h"
#include "common/sensor/membrane_view.h"

namespace tacipc {

/// Over the object's own plane: a grid of the camera's size and pixel about the object's axis, turned with it.
/// Channels: height of the surface in frame S less that of the object's origin (m), and how much steeper it is there
/// than the mesh's along x and y of the object (tangents). Where nothing is known: height 1 m, which no membrane has.
struct PrintRelief {
  FloatImage map;  // 3 channels
  double pixel_m = 0.0;

  /// \throw DataError if the file is not one of the camera's size
  static PrintRelief read(const std::filesystem::path& path, const Camera& camera);
  void write(const std::filesystem::path& path) const;
};

/// Where an object stands: its axis, turn about z and the height of its origin.
struct ObjectPlace {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
  double origin_z_m = 0.0;
};

/// Turns the normals by the relief's slopes where the membrane lies on the surface, to within 12 µm.
void apply_relief(const PrintRelief& relief, const ObjectPlace& place, MembraneView& view);

/// The normal that is steeper than `normal` by these slopes along x and y.
Vector3 steeper(const Vector3& normal, double slope_x, double slope_y);

}  // namespace tacipc
