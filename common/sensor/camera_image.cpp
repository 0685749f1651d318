#include "common/sensor/camera_image.h"

#include "common/base/error.h"

namespace tacipc {

void check_camera_size(const std::filesystem::path& path, int width_px, int height_px, const Camera& camera) {
  if (width_px == camera.width_px && height_px == camera.height_px) return;
  throw DataError("{}: is {} x {} pixels, the sensor's camera has {} x {}", path.string(), width_px, height_px,
                  camera.width_px, camera.height_px);
}

ByteImage read_photograph(const std::filesystem::path& path, const Camera& camera) {
  ByteImage image = read_png(path, 3);
  check_camera_size(path, image.width, image.height, camera);
  return image;
}

FloatImage read_camera_exr(const std::filesystem::path& path, const std::vector<std::string>& channel_names,
                           const Camera& camera) {
  FloatImage image = read_exr(path, channel_names);
  check_camera_size(path, image.width, image.height, camera);
  return image;
}

}  // namespace tacipc
