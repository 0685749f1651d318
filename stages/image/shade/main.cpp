#include <fmt/core.h>

#include <ctime>
#include <numbers>
#include <optional>

#include "common/base/error.h"
#include "common/base/statistics.h"
#include "common/benchmark/ball_press.h"
#include "common/image/picture.h"
#include "common/optics/seen_membrane.h"
#include "common/sample/pose_file.h"
#include "common/sensor/camera_image.h"
#include "common/sensor/print_relief.h"
#include "common/stage/stage.h"
#include "stages/image/shade/fit_place.h"

namespace {

using namespace tacipc;

const StageSpec kShade{
    .name = "shade",
    .summary = "Make tactile images of a press under a calibrated light, on a real background.",
    .inputs = {{.flag = "--config", .help = "which frames, where in the image (YAML)"},
               {.flag = "--sensor", .help = "the sensor: its camera (YAML)"},
               {.flag = "--light", .help = "light.yaml of calibrate"},
               {.flag = "--background", .help = "photograph without contact (PNG)"},
               {.flag = "--press", .help = "folder that press wrote", .required = false},
               {.flag = "--gel", .help = "gel.msh of that press", .required = false},
               {.flag = "--contact", .help = "contact.yaml of calibrate: contacts of a ball", .required = false},
               {.flag = "--photograph", .help = "photograph the place is fitted to (PNG)", .required = false},
               {.flag = "--relief", .help = "the object's print, of calibrate (EXR); with --press", .required = false},
               {.flag = "--shapes",
                .help = "indentation maps (EXR), one per image, in place of a press",
                .required = false,
                .many = true}}};

/// Processor seconds per image, without files.
struct Times {
  std::vector<double> view_s = {}, light_s = {};

  /// Calls `work` and records its time.
  template <typename Work>
  static auto timed(std::vector<double>& times, Work&& work) {
    const std::clock_t started = std::clock();
    auto result = work();
    times.push_back(static_cast<double>(std::clock() - started) / CLOCKS_PER_SEC);
    return result;
  }
  void tell(Stage& stage) const { stage.cost({{"view_s", upper_median(view_s)}, {"light_s", upper_median(light_s)}}); }
};

/// Renders one membrane and writes the image under its name, with its normals and its depth along the camera's axis.
void deliver(Stage& stage, const std::string& name, const MembraneView& view, const Sensor& sensor,
             const LightField& light, const ByteImage& background, Times& times) {
  write_png(stage.output(name + ".png"),
            Times::timed(times.light_s, [&] { return add_change(background, code_change(light, view)); }));
  FloatImage normals(view.width, view.height, 3);
  for (std::size_t i = 0; i < view.normal.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) normals.pixels[3 * i + k] = static_cast<float>(view.normal[i][k]);
  write_png(stage.output("normals/" + name + ".png"), picture_of_normals(normals));
  FloatImage depth(view.width, view.height, 1);
  for (std::size_t i = 0; i < view.point.size(); ++i)
    depth.pixels[i] = static_cast<float>(view.point[i].z() - sensor.camera.position_m.z());
  write_exr(stage.output("depth/" + name + ".exr"), depth, {"Y"});
}

void shade_shapes(Stage& stage, const ImagePlaces& config, const Sensor& sensor, const LightField& light,
                  const ByteImage& background) {
  const auto& shapes = stage.inputs("--shapes");
  if (shapes.size() != config.images.size())
    throw UsageError(fmt::format("{} --shapes for {} images", shapes.size(), config.images.size()));
  Times times;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const FloatImage indentation = read_camera_exr(shapes[i], {"Y"}, sensor.camera);
    const MembraneView view = Times::timed(times.view_s, [&] { return view_height_map(indentation, sensor); });
    deliver(stage, config.images[i].name, view, sensor, light, background, times);
  }
  times.tell(stage);
  stage.summarize({{"images", shapes.size()}});
}

void shade_press(Stage& stage, const ImagePlaces& config, const Sensor& sensor, const LightField& light,
                 const ByteImage& background) {
  const auto folder = *stage.optional_input("--press");
  const FrontFrames press = read_front_frames(folder, *stage.optional_input("--gel"));
  std::optional<PrintRelief> relief;
  if (const auto file = stage.optional_input("--relief")) relief = PrintRelief::read(*file, sensor.camera);
  for (const NamedFrame& image : config.images)
    if (static_cast<std::size_t>(image.frame) >= press.frames.size())
      throw DataError("{}: {} is to be frame {}, the press has frames up to {}", folder.string(), image.name,
                      image.frame, press.frames.size() - 1);
  FittedPlace fitted{.place = config.place};
  if (config.fit) {
    const ByteImage photograph = read_photograph(*stage.optional_input("--photograph"), sensor.camera);
    for (const NamedFrame& image : config.images)
      if (image.name == config.fit->image)
        fitted = fit_place(press, image.frame, config.place, *config.fit, photograph, background, light, sensor,
                           relief ? &*relief : nullptr);
  }
  Times times;
  std::vector<Matrix4> poses;
  for (const NamedFrame& image : config.images) {
    const auto frame = static_cast<std::size_t>(image.frame);
    const MembraneView view = Times::timed(
        times.view_s, [&] { return view_at(press, image.frame, fitted.place, relief ? &*relief : nullptr, sensor); });
    deliver(stage, image.name, view, sensor, light, background, times);
    poses.emplace_back(place_pose(fitted.place, sensor) * press.gel_from_object[frame]);
  }
  write_poses(stage, image_poses_field(), poses);
  times.tell(stage);
  const Vector3 center_m = place_pose(fitted.place, sensor).topRightCorner<3, 1>();
  Value::Map summary{{"images", config.images.size()},
                     {"center_px", Value::List{fitted.place.x_px, fitted.place.y_px}},
                     {"center_mm", Value::List{1e3 * center_m.x(), 1e3 * center_m.y()}},
                     {"yaw_deg", fitted.place.yaw_rad * 180.0 / std::numbers::pi}};
  if (config.fit) summary.emplace_back("fit", fitted.to_value(config.fit->image));
  stage.summarize(summary);
}

/// Content of contact.yaml.
struct ContactRim {
  double gap_m = 0.0;
  static ContactRim read(ConfigReader& in) { return {1e-3 * in.number("contact_gap_mm", Range::positive())}; }
};

void shade_contacts(Stage& stage, const ImagePlaces& config, const Sensor& sensor, const LightField& light,
                    const ByteImage& background) {
  const double radius_m = config.ball_radius_m.value();
  const BallPress press = read_ball_press(*stage.optional_input("--press"), *stage.optional_input("--gel"), radius_m,
                                          stage.read_config<ContactRim>("--contact").gap_m);
  Times times;
  std::vector<Matrix4> poses;
  Value::Map depths;
  for (const NamedFrame& image : config.images) {
    const ContactPlace& contact = image.contact.value();
    const double depth =
        press.depth_of_contact(contact.radius_px * sensor.camera.window_width_m / sensor.camera.width_px, image.name);
    const Matrix4 place = place_pose(contact.center, sensor);
    const MembraneView view = Times::timed(times.view_s, [&] {
      return view_membrane(at_place(press.at_depth(depth), contact.center, sensor), press.front, sensor);
    });
    deliver(stage, image.name, view, sensor, light, background, times);
    poses.push_back(ball_pose(place(0, 3), place(1, 3), depth, radius_m));
    depths.emplace_back(image.name, 1e3 * depth);
  }
  write_poses(stage, image_poses_field(), poses);
  times.tell(stage);
  stage.summarize({{"images", config.images.size()}, {"depth_mm", depths}});
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kShade, argc, argv, [](Stage& stage) {
    const bool press = stage.optional_input("--press").has_value(), gel = stage.optional_input("--gel").has_value();
    if (press != gel) throw UsageError("--press and --gel belong together");
    if (press != stage.inputs("--shapes").empty()) throw UsageError("give either --press or --shapes");
    const auto config = stage.read_config<ImagePlaces>("--config");
    if (stage.optional_input("--photograph").has_value() != (press && config.fit.has_value()))
      throw UsageError("--photograph: needed where a press is to be fitted to it, and only there");
    if (stage.optional_input("--contact").has_value() != (press && config.ball_radius_m.has_value()))
      throw UsageError("--contact: needed where a press is to match contacts of a ball, and only there");
    if (stage.optional_input("--relief").has_value() && (!press || config.ball_radius_m))
      throw UsageError("--relief: for a press at a depth, and only there");
    const auto sensor = stage.read_config<Sensor>("--sensor");
    const auto light = stage.read_config<LightField>("--light");
    const ByteImage background = read_photograph(stage.input("--background"), sensor.camera);
    if (press && config.ball_radius_m)
      shade_contacts(stage, config, sensor, light, background);
    else if (press)
      shade_press(stage, config, sensor, light, background);
    else
      shade_shapes(stage, config, sensor, light, background);
  });
}
