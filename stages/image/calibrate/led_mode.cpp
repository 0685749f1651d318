#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/sensor/camera_image.h"
#include "common/sensor/camera_model.h"
#include "stages/image/calibrate/led_intensities.h"
#include "stages/image/calibrate/modes.h"

namespace tacipc {
namespace {

/// Radiance after the lens's vignetting.
FloatImage through_lens(const FloatImage& radiance, const Camera& camera) {
  FloatImage out = radiance;
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < out.channels; ++c)
        out.at(x, y, c) = static_cast<float>(vignetting(camera, x, y) * radiance.at(x, y, c));
  return out;
}

}  // namespace

void calibrate_leds(Stage& stage) {
  for (const char* flag : {"--photographs", "--labels", "--press", "--gel"})
    if (stage.optional_input(flag)) throw UsageError(fmt::format("{} cannot be combined with --basis", flag));
  const auto config = stage.read_config<IntensityConfig>("--config");
  const Camera camera = stage.read_config<Sensor>("--sensor").camera;
  const ByteImage background = read_photograph(stage.input("--background"), camera);
  std::vector<FloatImage> basis;
  for (const auto& path : stage.inputs("--basis")) {
    basis.push_back(read_camera_exr(path, {"R", "G", "B"}, camera));
  }
  // The images show the light before the lens.
  const FloatImage even = through_lens(FloatImage(camera.width_px, camera.height_px, 1, 1.0f), camera);
  for (FloatImage& image : basis) image = through_lens(image, camera);
  FloatImage codes(background.width, background.height, 3);
  std::ranges::copy(background.pixels, codes.pixels.begin());
  const IntensityFit fit = fit_intensities(basis, even, codes, config);
  Value::List leds, deviations;
  for (Eigen::Index l = 0; l <= fit.rgb.rows(); ++l) {
    Value::List sigma;
    for (std::size_t c = 0; c < 3; ++c) sigma.push_back(std::sqrt(fit.covariance[c](l, l)));
    deviations.push_back(std::move(sigma));
    if (l < fit.rgb.rows())
      leds.push_back(Value::Map{{"rgb_linear", Value::List{fit.rgb(l, 0), fit.rgb(l, 1), fit.rgb(l, 2)}}});
  }
  const Value::List veil{fit.veil[0], fit.veil[1], fit.veil[2]};
  write_file(stage.output("leds.yaml"), to_yaml(Value::Map{{"leds", leds}, {"ambient", Value::Map{{"rgb", veil}}}}));
  write_exr(stage.output("residual.exr"), fit.residual, {"R", "G", "B"});
  stage.summarize({{"leds", basis.size()},
                   {"rmse_linear", Value::List{fit.rmse[0], fit.rmse[1], fit.rmse[2]}},
                   {"condition_number", fit.condition},
                   {"condition_number_with_veil", fit.condition_with_veil},
                   {"sigma_leds_then_veil", deviations}});
}

}  // namespace tacipc
