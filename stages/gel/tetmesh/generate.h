// Generates a gel from its sensor's shape and a sizing.
#pragma once

#include <cstdint>
#include <functional>

#include "common/mesh/tet_mesh.h"
#include "stages/gel/tetmesh/sizing.h"
#include "stages/gel/tetmesh/tet_fill.h"

namespace tacipc {

/// Configuration of a generated gel or soft object.
struct GenerateConfig {
  SizingConfig sizing;
  FillConfig fill;
  double max_vertices = 0.0;      // largest estimated number of vertices; more are refused before any work
  double min_dihedral_deg = 0.0;  // meshes with a smaller dihedral angle are rejected
  std::uint64_t seed = 0;

  static GenerateConfig read(ConfigReader& in);
};

/// Fills a surface with tetrahedra and checks them. If a check fails, the fill is repeated with TetGen's strongest
/// optimisation.
/// \throw DataError if TetGen fails; exceptions of `check` in the last attempt
TetMesh fill_and_check(const GelSurface& surface, const GenerateConfig& config,
                       const std::function<double(const Vector3&)>& edge_length_m,
                       const std::function<void(const TetMesh&)>& check);

/// Meshes a gel and checks it (check_gel).
/// \throw DataError for a sizing that is too fine or does not fit the gel, and for a mesh that fails the checks
TetMesh generate_gel(const GelShape& gel, const GenerateConfig& config);

}  // namespace tacipc
