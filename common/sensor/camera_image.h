// Images that must be as large as a sensor's camera.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// \throw DataError with both sizes if an image of `path` is not of the camera's
void check_camera_size(const std::filesystem::path& path, int width_px, int height_px, const Camera& camera);

/// A photograph as RGB. \throw DataError if it is not of the camera's size
ByteImage read_photograph(const std::filesystem::path& path, const Camera& camera);

/// The named channels of an EXR. \throw DataError if it is not of the camera's size
FloatImage read_camera_exr(const std::filesystem::path& path, const std::vector<std::string>& channel_names,
                           const Camera& camera);

}  // namespace tacipc
