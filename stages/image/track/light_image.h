// Computes the light of an image from its grey levels.
#pragma once

#include <string>

#include "common/image/image.h"

namespace tacipc {

/// Mean over the channels of the linear light of 8-bit grey levels, in [0, 1]: for `srgb` by the curve of IEC
/// 61966-2-1, for `linear` level / 255. A pixel half covered by a dot is half way between dot and surroundings in
/// light, but not in grey levels.
FloatImage light_of(const ByteImage& image, const std::string& curve);

}  // namespace tacipc
