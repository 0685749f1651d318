#include "stages/image/render/traction_parts.h"

#include <cassert>

namespace tacipc {

TractionParts parts_of(const FloatImage& traction, const FloatImage& normal) {
  assert(traction.pixels.size() == normal.pixels.size() && traction.channels == 3);
  TractionParts parts{FloatImage(traction.width, traction.height, 1), traction};
  for (std::size_t i = 0; i < parts.pressure.pixels.size(); ++i) {
    const float *t = &traction.pixels[3 * i], *n = &normal.pixels[3 * i];
    const double pressure = 0.0 - (double{n[0]} * t[0] + double{n[1]} * t[1] + double{n[2]} * t[2]);
    parts.pressure.pixels[i] = static_cast<float>(pressure);
    for (int c = 0; c < 3; ++c) parts.shear.pixels[3 * i + c] = static_cast<float>(t[c] + pressure * n[c]);
  }
  return parts;
}

}  // namespace tacipc
