#include "common/sensor/print_relief.h"

#include <algorithm>
#include <cmath>

#include "common/sensor/camera_image.h"

namespace tacipc {
namespace {

const std::vector<std::string> kReliefChannels{"height", "slope_x", "slope_y"};

}  // namespace

PrintRelief PrintRelief::read(const std::filesystem::path& path, const Camera& camera) {
  return {.map = read_camera_exr(path, kReliefChannels, camera), .pixel_m = camera.window_width_m / camera.width_px};
}

void PrintRelief::write(const std::filesystem::path& path) const { write_exr(path, map, kReliefChannels); }

Vector3 steeper(const Vector3& normal, double slope_x, double slope_y) {
  return Vector3(normal.x() - slope_x * normal.z(), normal.y() - slope_y * normal.z(), normal.z()).normalized();
}

void apply_relief(const PrintRelief& relief, const ObjectPlace& place, MembraneView& view) {
  constexpr double kTouching = 12e-6;
  const FloatImage& map = relief.map;
  const double cosine = std::cos(place.yaw_rad), sine = std::sin(place.yaw_rad);
  for (std::size_t i = 0; i < view.point.size(); ++i) {
    const double dx = view.point[i].x() - place.x_m, dy = view.point[i].y() - place.y_m;
    const double u = (cosine * dx + sine * dy) / relief.pixel_m + 0.5 * (map.width - 1);
    const double v = (cosine * dy - sine * dx) / relief.pixel_m + 0.5 * (map.height - 1);
    if (!(u >= 0.0 && v >= 0.0 && u <= map.width - 1 && v <= map.height - 1)) continue;
    const int x = std::min(static_cast<int>(u), map.width - 2), y = std::min(static_cast<int>(v), map.height - 2);
    const double a = u - x, b = v - y;
    const auto at = [&](int channel) {
      return (1 - b) * ((1 - a) * map.at(x, y, channel) + a * map.at(x + 1, y, channel)) +
             b * ((1 - a) * map.at(x, y + 1, channel) + a * map.at(x + 1, y + 1, channel));
    };
    if (!(std::abs(view.point[i].z() - place.origin_z_m - at(0)) < kTouching)) continue;
    const double along = at(1), across = at(2);
    view.normal[i] = steeper(view.normal[i], cosine * along - sine * across, sine * along + cosine * across);
  }
}

}  // namespace tacipc
