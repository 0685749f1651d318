#include "common/base/error.h"
#include "common/image/image.h"
#include "common/sample/object.h"
#include "common/sensor/sensor.h"
#include "common/stage/stage.h"
#include "stages/object/decimate/decimate_object.h"

namespace {

const tacipc::StageSpec kDecimate{
    .name = "decimate",
    .summary = "Repair a scanned object and simplify it to a mesh the simulation can afford.",
    .inputs = {{.flag = "--config", .help = "decimation settings (YAML)"},
               {.flag = "--mesh", .help = "surface of the object (STL, OBJ, OFF, PLY)"},
               {.flag = "--object", .help = "unit and orientation of that mesh (YAML)"},
               {.flag = "--sensor",
                .help = "who will see it (YAML): its window decides which side shows most",
                .required = false}}};

/// Messages of what is wrong with a mesh name its file.
tacipc::DecimatedObject decimated(const std::filesystem::path& path, double unit_m,
                                  const tacipc::DecimateConfig& config) {
  const tacipc::TriangleMesh scan = tacipc::read_triangle_mesh(path, unit_m);
  try {
    return tacipc::decimate_object(scan, config);
  } catch (const tacipc::DataError& error) {
    throw tacipc::DataError("{}: {}", path.string(), error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  return tacipc::run_stage(kDecimate, argc, argv, [](tacipc::Stage& stage) {
    auto config = stage.read_config<tacipc::DecimateConfig>("--config");
    const auto spec = stage.read_config<tacipc::ObjectSpec>("--object");
    if (stage.optional_input("--sensor")) {
      const auto sensor = stage.read_config<tacipc::Sensor>("--sensor");
      config.doctor.window =
          tacipc::SensorWindow{.size_m = {sensor.camera.window_width_m, sensor.camera.window_height_m},
                               .usual = spec.up ? tacipc::opposite_face(*spec.up) : "-z"};
    } else if (config.doctor.height_field && config.doctor.height_field->side == tacipc::SideConfig::kMostRelief) {
      throw tacipc::UsageError("height_field.side: most_relief needs --sensor, whose window decides");
    }
    const tacipc::DecimatedObject object = decimated(stage.input("--mesh"), tacipc::metres_per_unit(spec.unit), config);
    tacipc::write_ply(stage.output("object.ply"), object.mesh);
    if (object.sides) tacipc::write_png(stage.output("sides.png"), *object.sides);
    stage.summarize(object.summary);
  });
}
