// Gels and sizings the tests of the stage share.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "stages/gel/tetmesh/generate.h"
#include "stages/gel/tetmesh/statistics.h"

namespace tacipc {

inline std::filesystem::path config_path(const std::string& name) {
  return std::filesystem::path(TACIPC_SOURCE_DIR) / "configs" / name;
}

/// The shipped configuration of this name (`tiny`, …), which must generate.
GenerateConfig preset(const std::string& name);

/// The gel of the paper's sensor: a flat disc of radius 15 mm, 2 mm thick.
GelShape mctac_gel();
GelShape disc_gel(double radius_m, double thickness_m);
GelShape rectangle_gel(double width_m, double height_m, double thickness_m);

/// Expects that the mean edge of every region is as long as wanted within `tolerance` (a part), regions with fewer than
/// `min_edges` left out.
void expect_wanted_edges(const TetMesh& mesh, const GelShape& gel, const GenerateConfig& config, double tolerance,
                         Eigen::Index min_edges);

double volume_of(const TetMesh& mesh);

}  // namespace tacipc
