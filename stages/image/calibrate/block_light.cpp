#include "stages/image/calibrate/block_light.h"

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/sensor/camera_model.h"
#include "stages/image/calibrate/rest_membrane.h"

namespace tacipc {
namespace {

Sensor with_block_pixels(Sensor sensor, int block_px) {
  Camera& camera = sensor.camera;
  camera.width_px /= block_px;
  camera.height_px /= block_px;
  if (camera.intrinsics_px)
    for (double& value : *camera.intrinsics_px) value /= block_px;
  return sensor;
}

}  // namespace

BallPlace ball_place(const BallPress& press, const BallLabel& label, const Eigen::Vector3d& offsets_px,
                     const Sensor& sensor) {
  const CameraModel camera(sensor.camera, sensor.stack);
  const double column = label.x_px + 0.5 + offsets_px[0], row = label.y_px + 0.5 + offsets_px[1];
  const double radius = label.radius_px + offsets_px[2];
  const auto center = camera.on_plane(column, row), left = camera.on_plane(column - radius, row),
             right = camera.on_plane(column + radius, row);
  if (!center || !left || !right) throw DataError("{}: the camera does not see the gel there", label.image);
  return {center->x(), center->y(), press.depth_of_contact(0.5 * (*right - *left).norm(), label.image)};
}

BlockTracer::BlockTracer(const Sensor& sensor, int block_px, const TraceSettings& settings)
    : block_px_(block_px),
      settings_(settings),
      membrane_(rest_membrane(sensor.gel)),
      scene_(std::make_unique<RayScene>(membrane_.positions, membrane_.triangles)) {}

BlockTracer::BlockTracer(const BallPress& press, BallLabel label, int block_px, const TraceSettings& settings)
    : press_(&press),
      label_(std::move(label)),
      block_px_(block_px),
      settings_(settings),
      membrane_(make_membrane(press.frames[0], press.frames[0], press.front)),
      scene_(std::make_unique<RayScene>(membrane_.positions, membrane_.triangles)) {}

BlockTracer::~BlockTracer() = default;
BlockTracer::BlockTracer(BlockTracer&&) noexcept = default;

TraceResult BlockTracer::trace_blocks(const Sensor& sensor, const Eigen::Vector3d& offsets_px) {
  if (label_) {
    const BallPlace place = ball_place(*press_, *label_, offsets_px, sensor);
    // The finished press is moved there. Its changed distance to the rim is neglected.
    const Eigen::RowVector3d shift(place.x_m, place.y_m, 0.0);
    membrane_.positions = press_->at_depth(place.depth_m).rowwise() + shift;
    membrane_.rest = press_->frames[0].rowwise() + shift;
    membrane_.normals = vertex_normals(membrane_.positions, membrane_.triangles);
    scene_->move(membrane_.positions);
  }
  return trace(*scene_, membrane_, with_block_pixels(sensor, block_px_), settings_);
}

const BlockLight& BlockTracer::light(const Eigen::VectorXd& key, const Sensor& sensor,
                                     const Eigen::Vector3d& offsets_px) {
  constexpr std::size_t kRemembered = 2;  // for the current state of the fit and one trial step
  const auto known = std::ranges::find_if(remembered_, [&](const auto& one) { return one.first == key; });
  if (known != remembered_.end()) {
    std::rotate(known, known + 1, remembered_.end());
    return remembered_.back().second;
  }
  const TraceResult traced = trace_blocks(sensor, offsets_px);
  const int width = traced.basis.width, height = traced.basis.height;
  const Camera camera = with_block_pixels(sensor, block_px_).camera;
  const auto groups = light_groups(sensor.leds).size();
  BlockLight light;
  for (auto& columns : light)
    columns.resize(static_cast<Eigen::Index>(width) * height, static_cast<Eigen::Index>(groups) + 1);
  for (std::size_t g = 0; g <= groups; ++g) {
    const FloatImage image = g < groups ? group_image(traced, sensor, g) : FloatImage(width, height, 3, 1.0f);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          light[c](static_cast<Eigen::Index>(y) * width + x, static_cast<Eigen::Index>(g)) =
              vignetting(camera, x, y) * image.at(x, y, static_cast<int>(c));
  }
  if (remembered_.size() == kRemembered) remembered_.erase(remembered_.begin());
  remembered_.emplace_back(key, std::move(light));
  return remembered_.back().second;
}

std::vector<bool> BlockTracer::clean_blocks(const Sensor& sensor) {
  const TraceResult traced = trace_blocks(sensor, Eigen::Vector3d::Zero());
  const int width = traced.depth.width, height = traced.depth.height;
  std::vector<bool> clean;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      bool all_gel = true;
      for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u)
          all_gel = all_gel && std::isfinite(traced.depth.at(u, v, 0));
      clean.push_back(all_gel && (traced.coverage.channels == 0 || traced.coverage.at(x, y, 0) == 0.0f));
    }
  return clean;
}

}  // namespace tacipc
