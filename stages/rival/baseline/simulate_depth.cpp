#include "stages/rival/baseline/simulate_depth.h"

#include "stages/rival/baseline/deformation.h"
#include "stages/rival/baseline/phong.h"

namespace tacipc {
namespace {

FloatImage to_image(const Raster& raster) {
  FloatImage image(raster.width, raster.height, 1);
  for (std::size_t i = 0; i < raster.values.size(); ++i) image.pixels[i] = static_cast<float>(raster.values[i]);
  return image;
}

}  // namespace

BaselineFrame simulate_depth(const Raster& depth_m, const Raster& front_depth_m, const BaselineConfig& config,
                             const std::optional<ByteImage>& background) {
  const Raster h = protrusion(depth_m, front_depth_m);
  const Raster indentation = membrane_indentation(h, config.deformation.scaled_to(depth_m.width));
  Raster membrane = front_depth_m;
  for (std::size_t i = 0; i < membrane.values.size(); ++i) membrane.values[i] -= indentation.values[i];
  add_texture(membrane, config.texture_sigma_m, config.seed);
  BaselineFrame frame{.indentation = to_image(indentation), .depth = to_image(membrane), .tactile = std::nullopt};
  if (config.shading) frame.tactile = phong_image(*background, membrane, h, *config.shading);
  return frame;
}

Raster read_depth(const std::filesystem::path& path) {
  const FloatImage image = read_exr(path, {"Y"});
  Raster depth(image.width, image.height);
  for (std::size_t i = 0; i < depth.values.size(); ++i) depth.values[i] = image.pixels[i];
  return depth;
}

}  // namespace tacipc
