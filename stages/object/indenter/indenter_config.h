// What indenter is to make: a ball, or a mesh with the edges its print has.
#pragma once

#include <optional>
#include <string>

#include "common/config/config.h"

namespace tacipc {

struct RoundedMesh {
  std::string unit;  // of the file
  double edge_radius_m = 0.0;
  double spacing_m = 0.0;  // of the height field
  double relief_m = 0.0;   // how far below its highest point the object is kept
};

struct IndenterConfig {
  std::optional<double> ball_radius_m;
  double ball_edge_m = 0.0;
  std::optional<RoundedMesh> mesh;

  static IndenterConfig read(ConfigReader& in);
};

}  // namespace tacipc
