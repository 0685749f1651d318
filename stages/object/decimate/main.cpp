#include "common/base/error.h"
#include "common/base/log.h"
#include "common/image/image.h"
#include "common/sample/object.h"
#include "common/sample/object_file.h"
#include "common/sample/placement.h"
#include "common/sensor/sensor.h"
#include "common/stage/stage.h"
#include "stages/object/decimate/decimate_object.h"
#include "stages/object/decimate/object_size.h"

namespace {

const tacipc::StageSpec kDecimate{
    .name = "decimate",
    .summary = "Repair a scanned object and simplify it to a mesh the simulation can afford.",
    .inputs = {{.flag = "--config", .help = "decimation settings (YAML)"},
               {.flag = "--mesh", .help = "surface of the object (STL, OBJ, OFF, PLY, glTF, 3MF)"},
               {.flag = "--object", .help = "unit, scale, orientation and repair of that mesh (YAML)"},
               {.flag = "--sensor",
                .help = "who will see it (YAML): its window decides which side shows most",
                .required = false}}};

/// Adds the file's name to messages about its mesh.
tacipc::DecimatedObject decimated(const std::filesystem::path& path, const tacipc::TriangleMesh& mesh,
                                  const tacipc::DecimateConfig& config) {
  try {
    return tacipc::decimate_object(mesh, config);
  } catch (const tacipc::DataError& error) {
    throw tacipc::DataError("{}: {}", path.string(), error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  return tacipc::run_stage(kDecimate, argc, argv, [](tacipc::Stage& stage) {
    auto config = stage.read_config<tacipc::DecimateConfig>("--config");
    const auto spec = stage.read_config<tacipc::ObjectSpec>("--object");
    if (spec.wrap)
      throw tacipc::UsageError(stage.input("--object").string() +
                               ": wrap: is for the stage wrap; give --mesh and --object of what it made");
    config.doctor.sheet_thickness_m = spec.sheet_thickness_m;
    config.doctor.height_field = spec.height_field;
    if (stage.optional_input("--sensor")) {
      const auto sensor = stage.read_config<tacipc::Sensor>("--sensor");
      config.doctor.window =
          tacipc::SensorWindow{.size_m = {sensor.camera.window_width_m, sensor.camera.window_height_m},
                               .usual = spec.up ? tacipc::opposite_face(*spec.up) : "-z"};
    } else if (spec.height_field && spec.height_field->side == tacipc::SideConfig::kMostRelief) {
      throw tacipc::UsageError("height_field.side: most_relief needs --sensor, whose window decides");
    }
    if (spec.fit_window && !config.doctor.window)
      throw tacipc::UsageError("scale: fit needs --sensor, whose window is to be filled");
    tacipc::ObjectFile file = tacipc::read_object_file(stage.input("--mesh"), spec);
    config.doctor.unit = file.unit;
    tacipc::log_info("lengths are in {} ({})", file.unit, file.unit_from);
    double scale = spec.scale;
    if (spec.fit_window) {
      const auto& side = spec.height_field;
      scale = tacipc::scale_to_window(file.mesh, *config.doctor.window, side ? side->side : "");
      file.mesh.positions *= scale;
      tacipc::log_info("scaled by {:.4g} to fit the sensor's window", scale);
    }
    tacipc::DecimatedObject object = decimated(stage.input("--mesh"), file.mesh, config);
    object.summary.insert(object.summary.begin(),
                          {{"unit", file.unit}, {"unit_from", file.unit_from}, {"scale", scale}});
    tacipc::write_ply(stage.output("object.ply"), object.mesh);
    if (object.sides) tacipc::write_png(stage.output("sides.png"), *object.sides);
    stage.summarize(object.summary);
  });
}
