// A gel from a finished tetrahedral mesh: placed in the sensor frame, checked, and its boundary tagged.
#pragma once

#include <filesystem>
#include <optional>

#include "common/config/config.h"
#include "common/mesh/tet_mesh.h"
#include "common/sensor/sensor.h"

namespace tacipc {

struct ImportConfig {
  double unit_m = 1.0;                     // metres per unit of the file
  Matrix3 rotation = Matrix3::Identity();  // of the scaled file coordinates
  Vector3 scale = Vector3::Ones();         // per axis of the file, positive: no mirror
  Vector3 translation_m = Vector3::Zero();
  /// Which boundary triangles are glued: those with all vertices on a plane, or those that look backwards.
  std::optional<double> glued_plane_z_m;
  double glued_tolerance_m = 0.0;
  std::optional<double> glued_max_angle_deg;
  double front_max_angle_deg = 0.0;  // of the rest, those whose outward normal is within this angle of +z are front
  double fit_tolerance_m = 0.0;      // how far the mesh may differ from the sensor's gel
  double min_dihedral_deg = 0.0;

  static ImportConfig read(ConfigReader& in);
  /// x ↦ rotation · (scale ∘ x · unit_m) + translation
  Vector3 sensor_from_file(const Vector3& x) const;
};

struct ImportedGel {
  TetMesh mesh;          // vertices in file order
  bool flipped = false;  // all tets of the file were negative and have been turned
};

/// \throw DataError naming the file: unreadable, without tets, tets of mixed orientation or without volume, not the
/// sensor's shape, without a glued face, …
ImportedGel import_gel(const std::filesystem::path& path, const ImportConfig& config, const GelShape& gel);

}  // namespace tacipc
