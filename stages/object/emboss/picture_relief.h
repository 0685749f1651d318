// A grey picture as a relief.
#pragma once

#include "common/image/image.h"
#include "stages/object/emboss/texture.h"

namespace tacipc {

/// Size and walls of a picture's relief.
struct PictureRelief {
  double width_m = 0.0;       // width of the whole picture on the face
  double wall_m = 0.0;        // width of the wall at a step between two pixels
  bool dark_is_high = false;  // true: dark pixels are high; false: bright pixels are high
};

/// Height of a picture centred on the face, row 0 at the largest y: grey level / 255 (or its complement), blurred by a
/// Gaussian of σ = wall / √(2π) (a unit step then has the slope 1 / wall), linear between pixel centres. Outside the
/// picture the height is 0.
/// \param name name of the picture in messages
/// \throw DataError if all pixels have the same grey level
Height picture_height(const ByteImage& grey, const PictureRelief& relief, const std::string& name);

}  // namespace tacipc
