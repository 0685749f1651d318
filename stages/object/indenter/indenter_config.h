// Configuration of indenter: a ball, or a mesh with the rounded edges of its print.
#pragma once

#include <optional>
#include <string>

#include "common/config/config.h"

namespace tacipc {

/// Mesh whose edges are rounded like those of its print.
struct RoundedMesh {
  std::string unit;  // unit of the file's numbers
  double edge_radius_m = 0.0;
  double spacing_m = 0.0;  // grid spacing of the height field
  double relief_m = 0.0;   // depth below the highest point to which the object is kept
};

/// Exactly one of a ball and a mesh.
struct IndenterConfig {
  std::optional<double> ball_radius_m;
  double ball_edge_m = 0.0;
  std::optional<RoundedMesh> mesh;

  static IndenterConfig read(ConfigReader& in);
};

}  // namespace tacipc
