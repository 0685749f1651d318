// Configuration of the stage: how to generate a gel, or how to import one.
#pragma once

#include <variant>

#include "stages/gel/tetmesh/generate.h"
#include "stages/gel/tetmesh/import.h"

namespace tacipc {

/// Configuration of the stage tetmesh.
struct TetmeshConfig {
  std::variant<GenerateConfig, ImportConfig> way;

  /// Reads `kind: generate` or `kind: import`.
  static TetmeshConfig read(ConfigReader& in);
};

}  // namespace tacipc
