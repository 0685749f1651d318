// Imports a gel from a finished tetrahedral mesh: places it in the sensor frame, checks it and tags its boundary.
#pragma once

#include <filesystem>
#include <optional>

#include "common/config/config.h"
#include "common/mesh/tet_mesh.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Configuration of an import.
struct ImportConfig {
  double unit_m = 1.0;                     // metres per unit of the file
  Matrix3 rotation = Matrix3::Identity();  // rotation of the scaled file coordinates
  Vector3 scale = Vector3::Ones();         // scale per axis of the file, positive: no mirror
  Vector3 translation_m = Vector3::Zero();
  /// Glued boundary triangles: those with all vertices on a plane, or those that face backwards.
  std::optional<double> glued_plane_z_m;
  double glued_tolerance_m = 0.0;
  std::optional<double> glued_max_angle_deg;
  /// Remaining triangles with an outward normal within this angle of +z are front.
  double front_max_angle_deg = 0.0;
  double fit_tolerance_m = 0.0;  // largest deviation of the mesh from the sensor's gel
  double min_dihedral_deg = 0.0;

  static ImportConfig read(ConfigReader& in);
  /// Maps file coordinates: x ↦ rotation · (scale ∘ x · unit_m) + translation.
  Vector3 sensor_from_file(const Vector3& x) const;
};

/// An imported gel.
struct ImportedGel {
  TetMesh mesh;          // vertices in file order
  bool flipped = false;  // all tetrahedra of the file were negative and have been reoriented
};

/// Reads and checks a mesh.
/// \throw DataError that names the file: unreadable, without tetrahedra, tetrahedra of mixed orientation or without
/// volume, not the sensor's shape, without a glued face, …
ImportedGel import_gel(const std::filesystem::path& path, const ImportConfig& config, const GelShape& gel);

}  // namespace tacipc
