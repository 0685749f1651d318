#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/image/picture.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/pose_file.h"
#include "common/sample/render_folder.h"
#include "common/sensor/camera_image.h"
#include "common/stage/stage.h"
#include "stages/rival/baseline/kernel.h"
#include "stages/rival/baseline/object_depth.h"
#include "stages/rival/baseline/simulate_depth.h"

namespace {

using namespace tacipc;

const StageSpec kBaseline{
    .name = "baseline",
    .summary = "Make tactile images as the depth-based simulators do: blurred depth, Phong light.",
    .inputs = {{.flag = "--config", .help = "kernels and lights (YAML)"},
               {.flag = "--sensor", .help = "the sensor: camera and gel (YAML)"},
               {.flag = "--background", .help = "photograph without contact (PNG)", .required = false},
               {.flag = "--depth", .help = "depth maps (EXR)", .required = false, .many = true},
               {.flag = "--object",
                .help = "triangle mesh in metres (object.ply of decimate), in place of depth maps",
                .required = false},
               {.flag = "--pose", .help = "gel_from_object per frame (NPY)", .required = false}}};

std::vector<Raster> depth_maps(Stage& stage, const Camera& camera) {
  std::vector<Raster> maps;
  for (const auto& path : stage.inputs("--depth")) {
    maps.push_back(read_depth(path));
    check_camera_size(path, maps.back().width, maps.back().height, camera);
  }
  const auto mesh = stage.optional_input("--object"), pose = stage.optional_input("--pose");
  if (!mesh) return maps;
  const TriangleMesh object = read_triangle_mesh(*mesh, 1.0);
  for (const Matrix4& gel_from_object : read_poses(*pose))
    maps.push_back(object_depth(object, gel_from_object, camera, mesh->string()));
  return maps;
}

void check_flags(const Stage& stage) {
  const bool mesh = stage.optional_input("--object").has_value();
  if (mesh != stage.optional_input("--pose").has_value()) throw UsageError("--object and --pose belong together");
  if (mesh != stage.inputs("--depth").empty()) throw UsageError("give either --depth or --object");
}

/// An object's depth counts from this sensor's camera: above another's front, all of the image would be pressed.
void check_front(double front_depth_m, const Raster& own_front) {
  constexpr double kFrontToleranceM = 1e-5;
  for (const double depth_m : own_front.values)
    if (std::abs(depth_m - front_depth_m) > kFrontToleranceM)
      throw UsageError(
          fmt::format("front_depth_mm: {:g} is not this sensor's, {:g}, which --object needs; leave it out",
                      1e3 * front_depth_m, 1e3 * depth_m));
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kBaseline, argc, argv, [](Stage& stage) {
    check_flags(stage);
    const auto config = stage.read_config<BaselineConfig>("--config");
    const auto sensor = stage.read_config<Sensor>("--sensor");
    const auto photograph = stage.optional_input("--background");
    if (photograph.has_value() != config.shading.has_value())
      throw UsageError(photograph ? "--background: the configuration has no shading to use it"
                                  : "--background: needed where the configuration has shading");
    keep_to_one_thread();
    const Camera& camera = sensor.camera;
    std::optional<ByteImage> background;
    if (photograph) background = read_photograph(*photograph, camera);
    const Raster own_front = front_depth(sensor);
    if (config.front_depth_m && stage.optional_input("--object")) check_front(*config.front_depth_m, own_front);
    const Raster front =
        config.front_depth_m ? Raster(camera.width_px, camera.height_px, *config.front_depth_m) : own_front;
    double deepest_m = 0.0;
    const std::vector<Raster> maps = depth_maps(stage, camera);
    for (std::size_t i = 0; i < maps.size(); ++i) {
      const BaselineFrame frame = simulate_depth(maps[i], front, config, background);
      const std::string folder = frame_folder(i);
      write_frame(stage, folder, FrameFile::indentation, frame.indentation);
      write_frame(stage, folder, FrameFile::depth, frame.depth);
      const double top = *std::max_element(frame.indentation.pixels.begin(), frame.indentation.pixels.end());
      write_frame(stage, folder, FrameFile::indentation_picture, picture_of_height(frame.indentation));
      if (frame.tactile) write_frame(stage, folder, FrameFile::tactile, *frame.tactile);
      deepest_m = std::max(deepest_m, top);
    }
    if (stage.optional_input("--object") && !(deepest_m > 0.0))
      log_warning("{} is in the gel in no frame (it is read in metres)", stage.optional_input("--object")->string());
    stage.summarize({{"frames", maps.size()}, {"max_indentation_mm", 1e3 * deepest_m}});
  });
}
