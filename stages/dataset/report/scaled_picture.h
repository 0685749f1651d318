// Pictures made smaller or larger.
#pragma once

#include "common/image/image.h"

namespace tacipc {

/// The largest copy that fits into the box and keeps its proportions, averaged where it gets smaller.
/// \pre 3 channels, width and height ≥ 1
ByteImage fitted_picture(const ByteImage& image, int width, int height);

}  // namespace tacipc
