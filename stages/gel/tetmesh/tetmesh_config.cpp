#include "stages/gel/tetmesh/tetmesh_config.h"

namespace tacipc {

TetmeshConfig TetmeshConfig::read(ConfigReader& in) {
  if (in.choice("kind", {"generate", "import"}) == "import") return {ImportConfig::read(in)};
  return {GenerateConfig::read(in)};
}

}  // namespace tacipc
