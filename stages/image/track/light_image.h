// Light of an image, from its codes.
#pragma once

#include <string>

#include "common/image/image.h"

namespace tacipc {

/// Mean over the channels of the linear light behind 8-bit codes, in [0, 1]: of `srgb` by IEC 61966-2-1's curve, of
/// `linear` code / 255. In light, a pixel that a dot half covers lies half way between dot and surrounding; in codes it
/// does not.
FloatImage light_of(const ByteImage& image, const std::string& curve);

}  // namespace tacipc
