// sensor YAML + sizing → tagged tetrahedral gel; or a finished mesh, placed and tagged.
#include "common/base/error.h"
#include "common/stage/stage.h"
#include "stages/gel/tetmesh/statistics.h"
#include "stages/gel/tetmesh/tetmesh_config.h"

using namespace tacipc;

namespace {

const StageSpec kTetmesh{.name = "tetmesh",
                         .summary = "Mesh a sensor's gel with graded tetrahedra, or import a finished mesh.",
                         .inputs = {{"--config", "sizing, or how to place an imported mesh (YAML)"},
                                    {"--sensor", "the sensor, whose gel is meshed (YAML)"},
                                    {"--import", "finished tetrahedral mesh (Gmsh MSH), with kind: import", false}}};

/// A generated gel; messages name the two files that it is made of.
TetMesh generated(const Stage& stage, const GelShape& gel, const GenerateConfig& config) {
  try {
    return generate_gel(gel, config);
  } catch (const DataError& error) {
    throw DataError("{} with the gel of {}: {}", stage.input("--config").string(), stage.input("--sensor").string(),
                    error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kTetmesh, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<TetmeshConfig>("--config");
    const auto sensor = stage.read_config<Sensor>("--sensor");
    const auto file = stage.optional_input("--import");
    const auto* import_config = std::get_if<ImportConfig>(&config.way);
    if (import_config != nullptr && !file) throw UsageError("--config says kind: import, so --import is needed");
    if (import_config == nullptr && file) throw UsageError("--import needs a --config with kind: import");
    TetMesh mesh;
    std::function<double(const Vector3&)> wanted;
    if (import_config != nullptr) {
      ImportedGel imported = import_gel(*file, *import_config, sensor.gel);
      mesh = std::move(imported.mesh);
      stage.summarize({{"tets_turned", imported.flipped}});
    } else {
      const auto& generate = std::get<GenerateConfig>(config.way);
      mesh = generated(stage, sensor.gel, generate);
      wanted = [sizing = sizing_for(generate.sizing, sensor.gel)](const Vector3& x) {
        return target_edge_length(sizing, x);
      };
    }
    write_tet_mesh(stage.output("gel.msh"), mesh);
    stage.summarize(summary(mesh, sensor.gel, wanted));
  });
}
