#include "stages/rival/baseline/simulator.h"

#include <fmt/core.h>

#include <cmath>
#include <ctime>

#include "common/base/error.h"
#include "common/mesh/vertex_normals.h"
#include "common/sensor/light_field.h"
#include "stages/rival/baseline/deformation.h"
#include "stages/rival/baseline/phong.h"

namespace tacipc {
namespace {

/// Checks the front: an object's depth counts from this sensor's camera. Above another sensor's front, the whole image
/// would be pressed.
void check_front(double front_depth_m, const Raster& own_front) {
  constexpr double kFrontToleranceM = 1e-5;
  for (const double depth_m : own_front.values)
    if (std::abs(depth_m - front_depth_m) > kFrontToleranceM)
      throw UsageError(
          fmt::format("front_depth_mm: {:g} is not this sensor's, {:g}, which --object needs; leave it out",
                      1e3 * front_depth_m, 1e3 * depth_m));
}

}  // namespace

BaselineSimulator::BaselineSimulator(const BaselineConfig& config, const Sensor& sensor,
                                     std::optional<ByteImage> background,
                                     const std::optional<std::filesystem::path>& light,
                                     const std::optional<std::filesystem::path>& shadows)
    : config_(config),
      sensor_(sensor),
      camera_(sensor, config.rays),
      front_(camera_.front()),
      background_(std::move(background)) {
  const Camera& camera = sensor.camera;
  config_.deformation = config.deformation.scaled_to(camera.width_px, camera.window_width_m / camera.width_px);
  if (config.front_depth_m) front_ = Raster(camera.width_px, camera.height_px, *config.front_depth_m);
  if (config.change)
    change_.emplace(*config.change, light ? read_light(*light, config.change->model, sensor.camera) : RivalLight{},
                    sensor, shadows ? std::optional(ShadowTable::read(*shadows)) : std::nullopt,
                    config.deformation.designed_pixel_m);
}

void BaselineSimulator::take_object(const std::filesystem::path& mesh) {
  if (config_.front_depth_m) check_front(*config_.front_depth_m, camera_.front());
  object_ = read_triangle_mesh(mesh, 1.0);
  name_ = mesh.string();
  if (config_.deformation.method == DeformationConfig::Method::rigid && config_.change &&
      config_.change->model == ChangeConfig::Model::metallic_roughness)
    normals_ = vertex_normals(object_->positions, object_->triangles);
}

SeenObject BaselineSimulator::seen(Matrix4 pose) const {
  if (config_.force)
    pose.topRightCorner<3, 1>() += config_.force->way_m(pose.topRightCorner<3, 1>(), sensor_.camera.position_m);
  return camera_.see(object_.value(), normals_, pose, name_);
}

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

BaselineFrame BaselineSimulator::frame(SeenObject object_seen) const {
  const double started = processor_s();
  const Raster h = protrusion(object_seen.depth, front_);
  const Raster indentation = membrane_indentation(h, config_.deformation, object_seen.pressed_m);
  Raster membrane = front_;
  for (std::size_t i = 0; i < membrane.values.size(); ++i) membrane.values[i] -= indentation.values[i];
  add_texture(membrane, config_.texture_sigma_m, config_.seed);
  const double shaped = processor_s();
  BaselineFrame frame{.indentation = to_image(indentation), .depth = to_image(membrane), .tactile = std::nullopt};
  frame.membrane_s = shaped - started;
  if (config_.phong)
    frame.tactile =
        phong_image(*background_, membrane, config_.phong->darkened_by_membrane ? indentation : h, *config_.phong);
  if (change_) {
    for (std::size_t i = 0; i < object_seen.normal.size(); ++i)
      if (!(h.values[i] > 0.0)) object_seen.normal[i] = Vector3::Zero();
    const std::vector<bool> held = held_pixels(h, config_.deformation, object_seen.pressed_m);
    frame.tactile = add_change(*background_, (*change_)(indentation, object_seen.normal, held));
    add_noise(*frame.tactile, config_.change->noise_codes, config_.seed);
  }
  frame.light_s = processor_s() - shaped;
  return frame;
}

Raster read_depth(const std::filesystem::path& path) {
  const FloatImage image = read_exr(path, {"Y"});
  Raster depth(image.width, image.height);
  for (std::size_t i = 0; i < depth.values.size(); ++i) depth.values[i] = image.pixels[i];
  return depth;
}

}  // namespace tacipc
