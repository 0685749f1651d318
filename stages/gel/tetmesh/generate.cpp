#include "stages/gel/tetmesh/generate.h"

#include "common/base/error.h"
#include "common/base/log.h"
#include "stages/gel/tetmesh/gel_surface.h"
#include "stages/gel/tetmesh/mesh_check.h"

namespace tacipc {

GenerateConfig GenerateConfig::read(ConfigReader& in) {
  GenerateConfig config;
  ConfigReader sizing = in.section("sizing");
  config.sizing = SizingConfig::read(sizing);
  ConfigReader fill = in.section("tetrahedra");
  config.fill = FillConfig::read(fill);
  ConfigReader limits = in.section("limits");
  config.max_vertices = limits.number("max_vertices", Range::between(8, 1e8));
  config.min_dihedral_deg = limits.number("min_dihedral_deg", Range::between(0.0, 20.0));
  config.seed = static_cast<std::uint64_t>(in.integer("seed", 0));
  return config;
}

TetMesh fill_and_check(const GelSurface& surface, const GenerateConfig& config,
                       const std::function<double(const Vector3&)>& edge_length_m,
                       const std::function<void(const TetMesh&)>& check) {
  constexpr int kStrongestOptimization = 10;
  const auto checked = [&](const FillConfig& fill) {
    TetMesh mesh = fill_with_tets(surface, fill, edge_length_m);
    check(mesh);
    return mesh;
  };
  FillConfig fill = config.fill;
  fill.max_vertices = static_cast<int>(config.max_vertices);
  if (fill.optimization_level < kStrongestOptimization) {
    try {
      return checked(fill);
    } catch (const DataError& error) {
      log_warning("{}; trying again with optimization_level {}", error.what(), kStrongestOptimization);
    }
    fill.optimization_level = kStrongestOptimization;
  }
  return checked(fill);
}

TetMesh generate_gel(const GelShape& gel, const GenerateConfig& config) {
  const Sizing sizing = sizing_for(config.sizing, gel);
  const double estimate = estimated_vertices(sizing);
  if (!(estimate <= config.max_vertices)) {
    throw DataError("the sizing asks for about {:.3g} vertices, more than max_vertices {:g}", estimate,
                    config.max_vertices);
  }
  log_info("the sizing asks for about {:.0f} vertices", estimate);
  const GelSurface surface = gel_surface(sizing, config.seed);
  log_info("surface: {} vertices, {} triangles", surface.positions.rows(), surface.triangles.rows());
  return fill_and_check(
      surface, config, [&](const Vector3& x) { return target_edge_length(sizing, x); },
      [&](const TetMesh& mesh) { check_gel(mesh, gel, {.min_dihedral_deg = config.min_dihedral_deg}, "gel"); });
}

}  // namespace tacipc
