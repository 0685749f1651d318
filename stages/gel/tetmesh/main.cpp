// Stage tetmesh: sensor YAML + sizing → tagged tetrahedral gel; or a finished mesh, placed and tagged; or a surface →
// soft object.
#include "common/base/error.h"
#include "common/mesh/triangle_mesh.h"
#include "common/stage/stage.h"
#include "stages/gel/tetmesh/soft_object.h"
#include "stages/gel/tetmesh/statistics.h"
#include "stages/gel/tetmesh/tetmesh_config.h"

using namespace tacipc;

namespace {

const StageSpec kTetmesh{
    .name = "tetmesh",
    .summary = "Mesh a sensor's gel with graded tetrahedra, or a soft object, or import a mesh.",
    .inputs = {
        {"--config", "sizing, or how to place an imported mesh (YAML)"},
        {"--sensor", "the sensor, whose gel is meshed (YAML)", false},
        {"--object", "closed triangle mesh of a soft object in metres (object.ply of decimate), in place of a sensor",
         false},
        {"--import", "finished tetrahedral mesh (Gmsh MSH), with kind: import", false}}};

/// Generates a mesh; messages name the two files from which it is made.
template <typename Make>
TetMesh generated(const Stage& stage, const std::string& shape, Make&& make) {
  try {
    return make();
  } catch (const DataError& error) {
    throw DataError("{} with {}: {}", stage.input("--config").string(), shape, error.what());
  }
}

void mesh_gel(Stage& stage, const TetmeshConfig& config) {
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
    mesh = generated(stage, "the gel of " + stage.input("--sensor").string(),
                     [&] { return generate_gel(sensor.gel, generate); });
    wanted = [sizing = sizing_for(generate.sizing, sensor.gel)](const Vector3& x) {
      return target_edge_length(sizing, x);
    };
  }
  write_tet_mesh(stage.output("gel.msh"), mesh);
  stage.summarize(summary(mesh, sensor.gel, wanted));
}

void mesh_soft_object(Stage& stage, const TetmeshConfig& config, const std::filesystem::path& file) {
  const auto* generate = std::get_if<GenerateConfig>(&config.way);
  if (generate == nullptr || stage.optional_input("--import"))
    throw UsageError("--object needs a --config with kind: generate, and no --import: only a gel can be imported");
  const TriangleMesh surface = read_triangle_mesh(file, 1.0);
  const TetMesh mesh =
      generated(stage, "the surface of " + file.string(), [&] { return mesh_object(surface, *generate); });
  write_tet_mesh(stage.output("object.msh"), mesh);
  stage.summarize(summary(mesh, generate->sizing.centre_m));
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kTetmesh, argc, argv, [](Stage& stage) {
    const auto object = stage.optional_input("--object");
    if (object.has_value() == stage.optional_input("--sensor").has_value())
      throw UsageError("give --sensor to mesh its gel, or --object to mesh a soft object");
    const auto config = stage.read_config<TetmeshConfig>("--config");
    if (object) {
      mesh_soft_object(stage, config, *object);
    } else {
      mesh_gel(stage, config);
    }
  });
}
