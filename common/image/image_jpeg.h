// Decodes JPEG photographs, by libjpeg-turbo.
#pragma once

#include <string>
#include <string_view>

#include "common/image/image.h"

namespace tacipc {

/// Returns whether the bytes begin like a JPEG.
bool is_jpeg(std::string_view bytes);
/// Decodes to 3 channels (RGB) or 1 (grey), in the orientation of the camera.
/// \throw DataError naming the file
ByteImage decode_jpeg(std::string_view bytes, int channels, const std::string& name);

}  // namespace tacipc
