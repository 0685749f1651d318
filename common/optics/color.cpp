// Applies colours and paint to basis images: the part of rendering that needs no rays.
#include <tbb/parallel_for.h>

#include "common/optics/trace.h"

namespace tacipc {
namespace {

/// Adds out_c += factor_c Σ_g rgb_gc basis_g.
void add_colored(const FloatImage& basis, const std::vector<LightGroup>& groups, const std::array<double, 3>& factor,
                 FloatImage& out) {
  if (basis.channels == 0) return;
  std::vector<std::array<double, 3>> rgb;
  for (const LightGroup& group : groups) rgb.push_back(group.rgb);
  const auto width = static_cast<std::size_t>(out.width), count = rgb.size();
  tbb::parallel_for(0, out.height, [&](int y) {
    const float* from = basis.pixels.data() + static_cast<std::size_t>(y) * width * count;
    float* to = out.pixels.data() + static_cast<std::size_t>(y) * width * 3;
    for (std::size_t x = 0; x < width; ++x, from += count, to += 3) {
      std::array<double, 3> sum{};
      for (std::size_t g = 0; g < count; ++g)
        for (std::size_t c = 0; c < 3; ++c) sum[c] += rgb[g][c] * from[g];
      for (std::size_t c = 0; c < 3; ++c) to[c] = static_cast<float>(to[c] + factor[c] * sum[c]);
    }
  });
}

FloatImage veil(const FloatImage& like, const Sensor& sensor) {
  FloatImage image(like.width, like.height, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(sensor.ambient_rgb[i % 3]);
  return image;
}

}  // namespace

FloatImage color_image(const FloatImage& basis, const Sensor& sensor) {
  FloatImage image = veil(basis, sensor);
  add_colored(basis, light_groups(sensor.leds), sensor.coating.albedo, image);
  return image;
}

FloatImage group_image(const TraceResult& result, const Sensor& sensor, std::size_t group) {
  Sensor alone = sensor;
  alone.ambient_rgb = {};
  for (Led& led : alone.leds) led.rgb = {};
  const std::vector<LightGroup> groups = light_groups(sensor.leds);
  for (const int led : groups[group].leds) alone.leds[led].rgb = {1.0, 1.0, 1.0};
  return color_image(result, alone, false);
}

double indirect_share(const TraceResult& result, const Sensor& sensor) {
  if (result.indirect.channels == 0) return 0.0;
  TraceResult direct = result;
  direct.indirect = {};
  const auto sum = [](const FloatImage& image) {
    double total = 0.0;
    for (const float value : image.pixels) total += value;
    return total;
  };
  const double with = sum(color_image(result, sensor, false)), without = sum(color_image(direct, sensor, false));
  return with > 0.0 ? 1.0 - without / with : 0.0;
}

FloatImage color_image(const TraceResult& result, const Sensor& sensor, bool with_markers) {
  const std::vector<LightGroup> groups = light_groups(sensor.leds);
  FloatImage image = color_image(result.basis, sensor);
  add_colored(result.gloss, groups, {1.0, 1.0, 1.0}, image);
  std::array<double, 3> twice{};
  for (std::size_t c = 0; c < 3; ++c) twice[c] = sensor.coating.albedo[c] * sensor.coating.albedo[c];
  add_colored(result.indirect, groups, twice, image);
  if (!with_markers || result.coverage.channels == 0) return image;
  std::array<double, 3> change{};
  for (std::size_t c = 0; c < 3; ++c) change[c] = sensor.markers.albedo[c] - sensor.coating.albedo[c];
  add_colored(result.marked, groups, change, image);
  add_colored(result.marked_gloss, groups, {-1.0, -1.0, -1.0}, image);
  // Ambient light also meets the markers' paint.
  FloatImage everywhere(image.width, image.height, 3);
  if (result.indirect.channels > 0) add_colored(result.indirect, groups, sensor.coating.albedo, everywhere);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const std::size_t c = i % 3;
    const double albedo = sensor.coating.albedo[c];
    const double veiled = albedo > 0.0 ? sensor.ambient_rgb[c] / albedo : 0.0;
    image.pixels[i] = static_cast<float>(image.pixels[i] +
                                         result.coverage.pixels[i / 3] * change[c] * (everywhere.pixels[i] + veiled));
  }
  return image;
}

}  // namespace tacipc
