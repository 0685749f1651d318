// A grey picture as a relief.
#pragma once

#include "common/image/image.h"
#include "stages/object/emboss/texture.h"

namespace tacipc {

struct PictureRelief {
  double width_m = 0.0;       // of the whole picture on the face
  double wall_m = 0.0;        // width that a step between two pixels gets
  bool dark_is_high = false;  // else white is
};

/// Height of a picture centred on the face, its row 0 at the largest y: grey / 255 (or its complement), blurred by a
/// Gaussian of σ = wall / √(2π) (a unit step then has the slope 1 / wall), linear between pixel centres. Around the
/// picture the height is 0. `name` stands for it in messages. \throw DataError if all pixels have the same grey.
Height picture_height(const ByteImage& grey, const PictureRelief& relief, const std::string& name);

}  // namespace tacipc
