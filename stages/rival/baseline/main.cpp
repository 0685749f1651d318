
#include <algorithm>
#include <numbers>
#include <optional>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/statistics.h"
#include "common/benchmark/image_places.h"
#include "common/image/picture.h"
#include "common/sample/pose_file.h"
#include "common/sample/render_folder.h"
#include "common/sensor/camera_image.h"
#include "common/stage/stage.h"
#include "stages/rival/baseline/kernel.h"
#include "stages/rival/baseline/marker_mode.h"
#include "stages/rival/baseline/simulator.h"

namespace {

using namespace tacipc;

const StageSpec kBaseline{
    .name = "baseline",
    .summary =
        "Make tactile images as simulators do that know the object's depth alone: its shape, blurred, and a light.",
    .inputs = {
        {"--config", "kernels and lights (YAML)"},
        {"--sensor", "the sensor: camera and gel (YAML)"},
        InputSpec::optional("--background", "photograph without contact (PNG)"),
        InputSpec::optional("--light",
                            "table (NPY, or Taxim's polycalib.npz) or network (NPY), lamps or our light (YAML) of "
                            "calibrate, where the shading has its light there"),
        InputSpec::optional("--shadows", "Taxim's shadows beside a contact (NPY), for the model table"),
        InputSpec::any_number("--depth", "depth maps (EXR)"),
        InputSpec::optional("--object", "triangle mesh in metres (object.ply of decimate), in place of depth maps"),
        InputSpec::optional("--pose", "gel_from_object per frame (NPY)"),
        InputSpec::optional("--places", "which of these poses, moved where in the image (YAML, as for shade)"),
        InputSpec::optional("--photograph", "photograph the place is fitted to (PNG)"),
        InputSpec::optional("--press",
                            "folder of a press of the object, whose way its markers go (with a section markers)"),
        InputSpec::optional(
            "--response",
            "folder of a press of a small object in the middle, then along x: unit responses of markers")}};

void check_flags(const Stage& stage) {
  const bool mesh = stage.optional_input("--object").has_value();
  if (mesh != stage.optional_input("--pose").has_value()) throw UsageError("--object and --pose belong together");
  if (mesh != stage.inputs("--depth").empty()) throw UsageError("give either --depth or --object");
  if (stage.optional_input("--press") || stage.optional_input("--response"))
    throw UsageError("--press and --response are for a configuration with markers");
  if (!mesh && stage.optional_input("--places")) throw UsageError("--places: moves an object, which --depth has not");
}

/// Checks that the flags match the configuration.
/// \throw UsageError
void check_light(const Stage& stage, const BaselineConfig& config) {
  const bool photograph = stage.optional_input("--background").has_value();
  if (photograph != config.shades())
    throw UsageError(photograph ? "--background: the configuration has no shading to use it"
                                : "--background: needed where the configuration has shading");
  const bool light = stage.optional_input("--light").has_value();
  if (light != (config.change && config.change->needs_light()))
    throw UsageError(light ? "--light: the configuration's shading has its own"
                           : "--light: needed for the configuration's shading");
  if (stage.optional_input("--shadows") && !(config.change && config.change->model == ChangeConfig::Model::table &&
                                             config.deformation.method == DeformationConfig::Method::pyramid))
    throw UsageError("--shadows: is for a pyramid under a table, as Taxim has it");
  if (config.force && !stage.optional_input("--object"))
    throw UsageError("contact_force: moves an object, which --depth has not");
}

BaselineSimulator make_simulator(Stage& stage) {
  const auto config = stage.read_config<BaselineConfig>("--config");
  const auto sensor = stage.read_config<Sensor>("--sensor");
  check_light(stage, config);
  std::optional<ByteImage> background;
  if (const auto photograph = stage.optional_input("--background"))
    background = read_photograph(*photograph, sensor.camera);
  BaselineSimulator out(config, sensor, std::move(background), stage.optional_input("--light"),
                        stage.optional_input("--shadows"));
  if (const auto mesh = stage.optional_input("--object")) out.take_object(*mesh);
  return out;
}

/// Poses, or those of the images that --places names, moved to the position given there or found on the photograph.
std::vector<Matrix4> wanted_poses(Stage& stage, const BaselineSimulator& simulator) {
  std::vector<Matrix4> poses = read_poses(*stage.optional_input("--pose"));
  if (!stage.optional_input("--places")) return poses;
  const auto places = stage.read_config<ImagePlaces>("--places");
  if (places.ball_radius_m) throw UsageError("--places: images are told by contacts, which only shade knows");
  for (const NamedFrame& image : places.images)
    if (static_cast<std::size_t>(image.frame) >= poses.size())
      throw DataError("{}: {} is to be frame {}, there are poses up to {}", stage.optional_input("--pose")->string(),
                      image.name, image.frame, poses.size() - 1);
  const auto moved = [&](const ImagePlace& place, const NamedFrame& image) -> Matrix4 {
    return place_pose(place, simulator.sensor()) * poses[image.frame];
  };
  ImagePlace place = places.place;
  if (places.fit) {
    const auto file = stage.optional_input("--photograph");
    if (!file) throw UsageError("--photograph: needed where a place is to be fitted to it");
    if (!simulator.config().shades()) throw UsageError("--places: no place can be fitted without shading");
    const ByteImage photograph = read_photograph(*file, simulator.sensor().camera);
    const NamedFrame& image = *std::ranges::find(places.images, places.fit->image, &NamedFrame::name);
    const FittedPlace fitted = search_place(place, *places.fit, photograph, [&](const ImagePlace& at) {
      return *simulator.frame(simulator.seen(moved(at, image))).tactile;
    });
    place = fitted.place;
    stage.summarize({{"fit", fitted.to_value(image.name)}});
  }
  std::vector<Matrix4> out;
  for (const NamedFrame& image : places.images) out.push_back(moved(place, image));
  write_poses(stage, image_poses_field(), out);
  stage.summarize(
      {{"center_px", Value::List{place.x_px, place.y_px}}, {"yaw_deg", place.yaw_rad * 180.0 / std::numbers::pi}});
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kBaseline, argc, argv, [](Stage& stage) {
    if (ConfigReader::from_file(stage.input("--config")).has("markers")) return move_markers(stage);
    check_flags(stage);
    keep_to_one_thread();
    const BaselineSimulator simulator = make_simulator(stage);
    double deepest_m = 0.0;
    std::vector<double> object_s, membrane_s, light_s;
    const auto deliver = [&](std::size_t i, SeenObject seen) {
      const BaselineFrame frame = simulator.frame(std::move(seen));
      const std::string folder = frame_folder(i);
      write_frame(stage, folder, FrameFile::indentation, frame.indentation);
      write_frame(stage, folder, FrameFile::depth, frame.depth);
      const double top = *std::ranges::max_element(frame.indentation.pixels);
      write_frame(stage, folder, FrameFile::indentation_picture, picture_of_height(frame.indentation));
      if (frame.tactile) write_frame(stage, folder, FrameFile::tactile, *frame.tactile);
      deepest_m = std::max(deepest_m, top);
      membrane_s.push_back(frame.membrane_s);
      light_s.push_back(frame.light_s);
    };
    if (simulator.has_object()) {
      for (const Matrix4& pose : wanted_poses(stage, simulator)) {
        const double started = processor_s();
        SeenObject seen = simulator.seen(pose);
        object_s.push_back(processor_s() - started);
        deliver(membrane_s.size(), std::move(seen));
      }
      if (!(deepest_m > 0.0)) log_warning("{} is in the gel in no frame (it is read in metres)", simulator.name());
    } else {
      for (const auto& path : stage.inputs("--depth")) {
        SeenObject seen{.depth = read_depth(path)};
        check_camera_size(path, seen.depth.width, seen.depth.height, simulator.sensor().camera);
        deliver(membrane_s.size(), std::move(seen));
      }
    }
    stage.summarize({{"frames", membrane_s.size()}, {"max_indentation_mm", 1e3 * deepest_m}});
    // Processor seconds of a frame, without files.
    if (simulator.has_object()) stage.cost({{"object_s", upper_median(object_s)}});
    stage.cost({{"membrane_s", upper_median(membrane_s)}, {"light_s", upper_median(light_s)}});
  });
}
