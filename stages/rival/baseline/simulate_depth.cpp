#include "stages/rival/baseline/simulate_depth.h"

#include <ctime>

#include "common/sensor/light_field.h"
#include "stages/rival/baseline/deformation.h"
#include "stages/rival/baseline/phong.h"

namespace tacipc {
double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

BaselineFrame simulate_depth(SeenObject seen, const Raster& front_depth_m, const BaselineConfig& config,
                             const std::optional<ByteImage>& background, const ChangeOfCodes* change) {
  const double started = processor_s();
  const Raster h = protrusion(seen.depth, front_depth_m);
  const Raster indentation = membrane_indentation(h, config.deformation);
  Raster membrane = front_depth_m;
  for (std::size_t i = 0; i < membrane.values.size(); ++i) membrane.values[i] -= indentation.values[i];
  add_texture(membrane, config.texture_sigma_m, config.seed);
  const double shaped = processor_s();
  BaselineFrame frame{.indentation = to_image(indentation), .depth = to_image(membrane), .tactile = std::nullopt};
  frame.membrane_s = shaped - started;
  if (config.phong) frame.tactile = phong_image(*background, membrane, h, *config.phong);
  if (change) {
    for (std::size_t i = 0; i < seen.normal.size(); ++i)
      if (!(h.values[i] > 0.0)) seen.normal[i] = Vector3::Zero();
    frame.tactile = add_change(*background, (*change)(indentation, seen.normal));
    add_noise(*frame.tactile, config.change->noise_codes, config.seed);
  }
  frame.light_s = processor_s() - shaped;
  return frame;
}

Raster read_depth(const std::filesystem::path& path) {
  const FloatImage image = read_exr(path, {"Y"});
  Raster depth(image.width, image.height);
  for (std::size_t i = 0; i < depth.values.size(); ++i) depth.values[i] = image.pixels[i];
  return depth;
}

}  // namespace tacipc
