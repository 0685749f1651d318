#include "stages/rival/baseline/phong.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "stages/rival/baseline/kernel.h"

namespace tacipc {
namespace {

void blur(ByteImage& image, const GaussianSize& size) {
  const Raster kernel = folded_gaussian(size.size_px, size.sigma_px);
  const cv::Mat weights(kernel.height, kernel.width, CV_64F, const_cast<double*>(kernel.values.data()));
  cv::Mat codes(image.height, image.width, CV_8UC3, image.pixels.data());
  cv::Mat blurred;
  cv::filter2D(codes, blurred, -1, weights);
  blurred.copyTo(codes);
}

}  // namespace

std::array<double, 3> phong_normal(const Raster& depth_m, double scale, int x, int y) {
  const auto slope = [&](int x0, int y0, int x1, int y1) {
    return (depth_m.at(x1, y1) / scale - depth_m.at(x0, y0) / scale) / 2.0;
  };
  const bool inner_x = x > 0 && x + 1 < depth_m.width, inner_y = y > 0 && y + 1 < depth_m.height;
  const double dx = inner_x ? slope(x - 1, y, x + 1, y) : 0.0, dy = inner_y ? slope(x, y - 1, x, y + 1) : 0.0;
  const double length = std::sqrt(dx * dx + dy * dy + 1.0);
  return {-dx / length, -dy / length, 1.0 / length};
}

std::uint8_t overlaid(double code, double opacity, double color) {
  return static_cast<std::uint8_t>(std::clamp((1.0 - opacity) * code + opacity * color, 0.0, 255.0));
}

double phong_opacity(const PhongLight& light, const std::array<double, 3>& normal, int shininess) {
  const auto& l = light.direction;
  const double d = normal[0] * l[0] + normal[1] * l[1] + normal[2] * l[2];
  const double reflected_z = 2.0 * d * normal[2] - l[2];
  return std::max(d * light.diffuse, 0.0) + std::pow(reflected_z, shininess) * light.specular;
}

ByteImage phong_image(const ByteImage& background, const Raster& depth_m, const Raster& darkening_m,
                      const PhongConfig& config) {
  assert(background.width == depth_m.width && background.height == depth_m.height && background.channels == 3);
  ByteImage out(background.width, background.height, 3);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const std::array<double, 3> normal = phong_normal(depth_m, config.metres_per_pixel, x, y);
      const double shade = std::clamp(darkening_m.at(x, y) / config.gel_thickness_m, 0.0, 1.0);
      for (int c = 0; c < 3; ++c) out.at(x, y, c) = overlaid(config.ambient * background.at(x, y, c), shade, 0.0);
      for (const PhongLight& light : config.lights) {
        const double opacity = phong_opacity(light, normal, config.shininess);
        for (int c = 0; c < 3; ++c) out.at(x, y, c) = overlaid(out.at(x, y, c), opacity, light.rgb[c]);
      }
    }
  }
  if (config.final_blur) blur(out, *config.final_blur);
  return out;
}

}  // namespace tacipc
