// Reads images that must have the size of a sensor's camera.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Checks the size of the image at `path`.
/// \throw DataError with both sizes if it differs from the camera's
void check_camera_size(const std::filesystem::path& path, int width_px, int height_px, const Camera& camera);

/// Reads a photograph as RGB.
/// \throw DataError if its size differs from the camera's
ByteImage read_photograph(const std::filesystem::path& path, const Camera& camera);

/// Reads the named channels of an EXR.
/// \throw DataError if its size differs from the camera's
FloatImage read_camera_exr(const std::filesystem::path& path, const std::vector<std::string>& channel_names,
                           const Camera& camera);

}  // namespace tacipc
