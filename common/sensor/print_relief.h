// Surface of a printed object as manufactured: slopes that its mesh lacks, from layers and uneven edges.
#pragma once

#include <filesystem>

#include "common/base/types.h"
#include "common/image/image.h"
#include "common/sensor/membrane_view.h"

namespace tacipc {

/// Relief over the object's plane: a grid with the camera's size and pixel pitch about the object's axis, which rotates
/// with the object. Channels: height of the surface in frame S above the object's origin (m), and the slopes (tangents)
/// along x and y of the object in addition to the mesh's. Unknown pixels have height 1 m, which no membrane reaches.
struct PrintRelief {
  FloatImage map;        // 3 channels
  double pixel_m = 0.0;  // pixel pitch, m

  /// Reads the relief.
  /// \throw DataError if the file does not have the camera's size
  static PrintRelief read(const std::filesystem::path& path, const Camera& camera);
  void write(const std::filesystem::path& path) const;
};

/// Position of an object: its axis, rotation about z and the height of its origin.
struct ObjectPlace {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;
  double origin_z_m = 0.0;
};

/// Tilts the normals by the relief's slopes where the membrane touches the surface, within 12 µm.
void apply_relief(const PrintRelief& relief, const ObjectPlace& place, MembraneView& view);

/// Returns `normal` with these slopes added along x and y.
Vector3 steeper(const Vector3& normal, double slope_x, double slope_y);

}  // namespace tacipc
