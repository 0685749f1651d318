// The finer uniform meshes of the paper, which take longer.
#include <gtest/gtest.h>

#include "stages/gel/tetmesh/generate.h"
#include "tests/stages/gel/tetmesh/gels.h"

namespace tacipc {
namespace generate_presets_fine_test {

TEST(FinePresets, AreUniform) {
  for (const char* name : {"uniform_0375um", "uniform_0250um"}) {
    SCOPED_TRACE(name);
    const GenerateConfig config = preset(name);
    expect_wanted_edges(generate_gel(mctac_gel(), config), mctac_gel(), config, 0.05, 50);
  }
}

}  // namespace generate_presets_fine_test
}  // namespace tacipc
