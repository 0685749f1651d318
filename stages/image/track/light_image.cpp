#include "stages/image/track/light_image.h"

#include <array>

#include "common/base/tone_curve.h"

namespace tacipc {

FloatImage light_of(const ByteImage& image, const std::string& curve) {
  std::array<double, 256> light{};
  for (std::size_t code = 0; code < light.size(); ++code)
    light[code] = ToneCurve::named(curve).value_of(static_cast<double>(code));
  FloatImage out(image.width, image.height, 1);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      double sum = 0.0;
      for (int c = 0; c < image.channels; ++c) sum += light[image.at(x, y, c)];
      out.at(x, y, 0) = static_cast<float>(sum / image.channels);
    }
  return out;
}

}  // namespace tacipc
