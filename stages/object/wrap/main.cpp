#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/sample/object_file.h"
#include "common/stage/stage.h"
#include "stages/object/wrap/wrap_object.h"

namespace {

using namespace tacipc;

const StageSpec kWrap{
    .name = "wrap",
    .summary = "Wrap a closed surface around a mesh that no repair closes.",
    .inputs = {{.flag = "--mesh", .help = "surface of the object (STL, OBJ, OFF, PLY, glTF, 3MF)"},
               {.flag = "--object", .help = "unit and scale of that mesh, how finely to wrap it (YAML)"}}};

/// Adds the file's name to messages about its mesh.
WrappedObject wrapped(const std::filesystem::path& path, const TriangleMesh& mesh, const WrapConfig& config) {
  try {
    return wrap_object(mesh, config);
  } catch (const DataError& error) {
    throw DataError("{}: {}", path.string(), error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kWrap, argc, argv, [](Stage& stage) {
    const auto spec = stage.read_config<ObjectSpec>("--object");
    const ObjectFile file = read_object_file(stage.input("--mesh"), spec);
    log_info("lengths are in {} ({})", file.unit, file.unit_from);
    const WrappedObject object = wrapped(stage.input("--mesh"), file.mesh, spec.wrap.value_or(WrapConfig{}));
    write_ply(stage.output("object.ply"), object.mesh);
    // With this object file decimate reads the wrap as it would have read the mesh.
    write_file(stage.output("object.yaml"), spec_of_wrapped(spec).yaml());
    stage.summarize({{"unit", file.unit}, {"unit_from", file.unit_from}, {"scale", spec.scale}});
    stage.summarize(object.summary);
  });
}
