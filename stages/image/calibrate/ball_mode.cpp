#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/units.h"
#include "common/sample/pose_file.h"
#include "common/sensor/camera_image.h"
#include "common/sensor/camera_model.h"
#include "stages/image/calibrate/fit_light.h"
#include "stages/image/calibrate/known_object.h"
#include "stages/image/calibrate/measure_relief.h"
#include "stages/image/calibrate/modes.h"
#include "stages/image/calibrate/sensor_file.h"

namespace tacipc {
namespace {

/// Picture of twice the model's residual around grey.
ByteImage residual_picture(const ByteImage& simulated, const ByteImage& real) {
  ByteImage out = simulated;
  for (std::size_t i = 0; i < out.pixels.size(); ++i)
    out.pixels[i] =
        static_cast<std::uint8_t>(std::clamp(128 + 2 * (int{simulated.pixels[i]} - int{real.pixels[i]}), 0, 255));
  return out;
}

Value::List lamp_lines(const LightFit& fit, int each) {
  constexpr std::array<const char*, 4> kNames{"azimuth_deg", "elevation_tan", "ln_distance_mm", "half_width_deg"};
  Value::List lines;
  Value::Map line;
  for (std::size_t i = 0; i < fit.knowledge.size(); ++i) {
    const LampKnowledge& known = fit.knowledge[i];
    const std::size_t k = i % static_cast<std::size_t>(each);
    const double unit = k == 0 || k == 3 ? 1.0 / kDegree : 1.0, shift = k == 2 ? std::log(1e3) : 0.0;
    line.emplace_back(kNames[k], Value::Map{{"value", unit * known.value + shift},
                                            {"sigma", unit * known.sigma},
                                            {"sigma_over_prior", known.sigma / known.prior},
                                            {"told_by", known.told ? "photographs" : "prior"}});
    if (k + 1 == static_cast<std::size_t>(each)) lines.push_back(std::exchange(line, {}));
  }
  return lines;
}

Value::Map summary_of(const LightFit& fit, std::size_t balls, const std::vector<KnownObject>& objects,
                      int lamp_parameters) {
  Value::Map held_out;
  for (const HeldOut& one : fit.held_out) held_out.emplace_back(name_of(one.kind), one.rmse_codes);
  Value::Map summary{{"photographs", balls},
                     {"model", name_of(fit.kind)},
                     {"held_out_rmse_codes", held_out},
                     {"rmse_codes", Value::List{fit.rmse_codes[0], fit.rmse_codes[1], fit.rmse_codes[2]}},
                     {"condition_number", fit.condition},
                     {"clipped_fraction", fit.unused_fraction}};
  Value::List known;
  for (const KnownObject& object : objects)
    known.push_back(Value::Map{{"name", object.known.name},
                               {"x_mm", 1e3 * object.x_m},
                               {"y_mm", 1e3 * object.y_m},
                               {"yaw_deg", object.yaw_rad / kDegree},
                               {"rmse_codes", object.rmse_codes},
                               {"left_out_rmse_codes", object.left_out_rmse_codes},
                               {"left_out_blocks_rmse_codes", object.left_out_blocks_rmse_codes}});
  if (!known.empty()) summary.emplace_back("objects", std::move(known));
  if (!fit.lamps) return summary;
  Value::List covariance;
  for (Eigen::Index i = 0; i < fit.lamps->covariance.rows(); ++i) {
    Value::List row;
    for (Eigen::Index j = 0; j < fit.lamps->covariance.cols(); ++j) row.push_back(fit.lamps->covariance(i, j));
    covariance.push_back(std::move(row));
  }
  summary.emplace_back("lamps", Value::Map{{"iterations", fit.lamps->iterations},
                                           {"converged", fit.lamps->converged},
                                           {"condition_number", fit.lamps->condition},
                                           {"fitted", lamp_lines(fit, lamp_parameters)},
                                           {"covariance", std::move(covariance)}});
  return summary;
}

/// Writes the sensor with the fitted light in place of its LEDs, next to the photograph that this light changes.
void write_calibrated_sensor(Stage& stage, const LightField& light) {
  const auto section = light.to_value().map().front();
  const std::vector<SensorChange> changes{{"leds"},
                                          {"coating"},
                                          {"ambient"},
                                          {"response"},
                                          {"markers.radius_mm"},
                                          {"markers.albedo"},
                                          {section.first, section.second},
                                          {"reference_image", "reference.png", "known"}};
  write_file(stage.output("sensor.yaml"),
             changed_sensor(stage.input("--sensor"), changes, "Light found by calibrate."));
  write_file(stage.output("reference.png"), read_file(stage.input("--background")));
}

/// Gap below which the ball counts as touching the membrane, in balls.csv.
constexpr double kTouchingM = 2e-5;

std::vector<KnownObject> read_objects(Stage& stage, const ByteImage& background, const CalibrateConfig& config,
                                      const Sensor& sensor, std::size_t balls) {
  std::vector<KnownObject> objects;
  const auto& presses = stage.named_inputs("--object-press");
  if (!stage.optional_input("--objects")) {
    if (!presses.empty()) throw UsageError("--object-press belongs to --objects");
    return objects;
  }
  const auto& shapes = stage.inputs("--shapes");
  const CameraModel rays(sensor.camera, sensor.stack);
  for (const KnownObjectConfig& known : stage.read_config<KnownObjectsConfig>("--objects").objects) {
    KnownObject object;
    object.known = known.grown(config.object_margin_px);
    const auto center = rays.on_plane(known.center_px[0] + 0.5, known.center_px[1] + 0.5);
    if (!center) throw DataError("{}: the camera does not see the front face at its centre", known.name);
    object.x_m = center->x();
    object.y_m = center->y();
    object.samples = object_samples(
        object.known, read_photograph(*stage.optional_input("--photographs") / known.photograph, sensor.camera),
        background, config.fit_stride_px);
    if (!shapes.empty()) {
      const std::size_t at = balls + objects.size();
      if (at < shapes.size()) object.view = view_height_map(read_camera_exr(shapes[at], {"Y"}, sensor.camera), sensor);
    } else {
      const auto press = std::ranges::find_if(presses, [&](const NamedPath& one) { return one.name == known.name; });
      if (press == presses.end()) throw UsageError(fmt::format("--object-press {}=… is missing", known.name));
      FrontFrames frames = read_front_frames(press->path, *stage.optional_input("--gel"));
      if (static_cast<std::size_t>(known.frame) >= frames.frames.size())
        throw DataError("{}: has no frame {}", press->path.string(), known.frame);
      object.triangles = std::move(frames.triangles);
      object.front = std::move(frames.frames[known.frame]);
      object.origin_z_m = frames.gel_from_object[known.frame](2, 3);
      if (known.frame > 1) {
        object.front_before = std::move(frames.frames[static_cast<std::size_t>(known.frame) - 1]);
        object.origin_z_before_m = frames.gel_from_object[static_cast<std::size_t>(known.frame) - 1](2, 3);
      }
      object.view = view_object(object, sensor);
    }
    objects.push_back(std::move(object));
  }
  return objects;
}

}  // namespace

void calibrate_balls(Stage& stage) {
  if (!stage.optional_input("--photographs") || !stage.optional_input("--labels"))
    throw UsageError("give --photographs and --labels of balls, or --basis, or a configuration with sensor_fit");
  const auto press_folder = stage.optional_input("--press"), gel = stage.optional_input("--gel");
  const auto& shapes = stage.inputs("--shapes");
  if (press_folder.has_value() != gel.has_value()) throw UsageError("--press and --gel belong together");
  if (press_folder.has_value() != shapes.empty()) throw UsageError("give either --press or --shapes");
  const auto config = stage.read_config<CalibrateConfig>("--config");
  const auto sensor = stage.read_config<Sensor>("--sensor");
  const Camera& camera = sensor.camera;
  const ByteImage background = read_photograph(stage.input("--background"), camera);
  const auto labels = read_labels(*stage.optional_input("--labels"));
  std::vector<KnownObject> objects = read_objects(stage, background, config, sensor, labels.size());
  if (!shapes.empty() && shapes.size() != labels.size() + objects.size())
    throw UsageError(objects.empty() ? fmt::format("{} --shapes for {} labels", shapes.size(), labels.size())
                                     : fmt::format("{} --shapes for {} labels and {} objects", shapes.size(),
                                                   labels.size(), objects.size()));
  std::optional<BallPress> press;
  if (press_folder) press = read_ball_press(*press_folder, *gel, config.ball_radius_m, config.contact_gap_m);

  std::vector<Ball> balls;
  std::vector<ByteImage> photographs;
  const CameraModel rays(camera, sensor.stack);
  const double pixel = camera.window_width_m / camera.width_px;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const BallLabel& label = labels[i];
    photographs.push_back(read_photograph(*stage.optional_input("--photographs") / label.image, camera));
    const auto center = rays.on_plane(label.x_px + 0.5, label.y_px + 0.5);
    if (!center) throw DataError("{}: the camera does not see the front face at the label's centre", label.image);
    Ball ball;
    ball.label = label;
    ball.x_m = center->x();
    ball.y_m = center->y();
    ball.samples = make_samples(photographs.back(), background, label, config);
    if (press) {
      ball.depth_m = press->depth_of_contact(label.radius_px * pixel, label.image);
      ball.view = view_ball(*press, ball, sensor);
    } else {
      const FloatImage indentation = read_camera_exr(shapes[i], {"Y"}, camera);
      ball.view = view_height_map(indentation, sensor);
    }
    balls.push_back(std::move(ball));
  }
  const LightFit fit = fit_light(balls, objects, press ? &*press : nullptr, sensor, config);

  write_file(stage.output("light.yaml"), to_yaml(fit.light.to_value()));
  write_calibrated_sensor(stage, fit.light);
  std::string table =
      press ? "image,x_mm,y_mm,depth_mm,rmse_codes,contact_mm\n" : "image,x_mm,y_mm,depth_mm,rmse_codes\n";
  std::vector<Matrix4> poses;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Ball& ball = balls[i];
    table += fmt::format("{},{},{},{},{}", ball.label.image, 1e3 * ball.x_m, 1e3 * ball.y_m, 1e3 * ball.depth_m,
                         ball.rmse_codes);
    if (press)
      table += fmt::format(
          ",{}", 1e3 * contact_radius(press->at_depth(ball.depth_m), ball.depth_m, config.ball_radius_m, kTouchingM));
    table += "\n";
    poses.push_back(ball_pose(ball.x_m, ball.y_m, ball.depth_m, config.ball_radius_m));
    const ByteImage simulated = add_change(background, code_change(fit.light, ball.view));
    write_png(stage.output("residuals/" + ball.label.image), residual_picture(simulated, photographs[i]));
  }
  write_file(stage.output("balls.csv"), table);
  if (press) {
    write_poses(stage, ball_poses_field(), poses);
    write_file(stage.output("contact.yaml"), to_yaml(Value::Map{{"contact_gap_mm", 1e3 * fit.contact_gap_m}}));
  }
  if (press && config.relief_slope > 0.0)
    for (const KnownObject& object : objects)
      measure_relief(object, read_photograph(*stage.optional_input("--photographs") / object.known.photograph, camera),
                     background, fit.light, sensor, config.relief_slope)
          .write(stage.output("relief/" + object.known.name + ".exr"));
  Value::Map summary = summary_of(fit, balls.size(), objects, parameters_per_lamp(config));
  if (press) summary.emplace_back("contact_gap_mm", 1e3 * fit.contact_gap_m);
  stage.summarize(summary);
}

}  // namespace tacipc
