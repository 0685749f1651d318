#include "common/sample/object.h"
#include "common/stage/stage.h"
#include "stages/object/decimate/decimate_object.h"

namespace {

const tacipc::StageSpec kDecimate{
    .name = "decimate",
    .summary = "Repair a scanned object and simplify it to a mesh the simulation can afford.",
    .inputs = {{.flag = "--config", .help = "decimation settings (YAML)"},
               {.flag = "--mesh", .help = "surface of the object (STL, OBJ, OFF, PLY)"},
               {.flag = "--object", .help = "unit and orientation of that mesh (YAML)"}}};

}  // namespace

int main(int argc, char** argv) {
  return tacipc::run_stage(kDecimate, argc, argv, [](tacipc::Stage& stage) {
    const auto config = stage.read_config<tacipc::DecimateConfig>("--config");
    const auto spec = stage.read_config<tacipc::ObjectSpec>("--object");
    const tacipc::TriangleMesh scan =
        tacipc::read_triangle_mesh(stage.input("--mesh"), tacipc::metres_per_unit(spec.unit));
    const tacipc::DecimatedObject object = tacipc::decimate_object(scan, config);
    tacipc::write_ply(stage.output("object.ply"), object.mesh);
    stage.summarize(object.summary);
  });
}
