#include "stages/render/render.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error.h"
#include "common/log.h"
#include "common/picture.h"
#include "stages/render/membrane.h"

namespace tacipc {
namespace {

double mean_of(const ByteImage& image) {
  std::uint64_t sum = 0;
  for (const std::uint8_t code : image.pixels) sum += code;
  return static_cast<double>(sum) / static_cast<double>(image.pixels.size());
}

double largest(const FloatImage& image) {
  double most = 0.0;
  for (const float value : image.pixels) {
    if (value > most) most = value;
  }
  return most;
}

void warn_of_dark_leds(const FloatImage& basis) {
  const auto num_leds = static_cast<std::size_t>(basis.channels);
  std::vector<bool> lit(num_leds, false);
  for (std::size_t i = 0; i < basis.pixels.size(); ++i) lit[i % num_leds] = lit[i % num_leds] || basis.pixels[i] > 0.0f;
  for (std::size_t led = 0; led < num_leds; ++led) {
    if (!lit[led]) log_warning("LED {} lights nothing the camera sees", led);
  }
}

}  // namespace

RenderConfig RenderConfig::read(ConfigReader& in) {
  RenderConfig config;
  config.all_frames = in.choice_or("frames", "last", {"last", "all"}) == "all";
  config.trace.subpixels = in.integer_or("subpixels", config.trace.subpixels, 1, 16);
  config.trace.led_samples = in.integer_or("led_samples", config.trace.led_samples, 1, 16);
  ConfigReader noise = in.section("noise");
  config.noise = NoiseModel::read(noise);
  return config;
}

Positions frame_positions(const NpyArray& positions, std::size_t frame) {
  const auto vertices = static_cast<Eigen::Index>(positions.shape[1]);
  return Eigen::Map<const Positions>(positions.data.data() + frame * positions.shape[1] * 3, vertices, 3);
}

void check_positions(const NpyArray& positions, const TetMesh& gel, const std::string& name) {
  const auto num_vertices = static_cast<std::size_t>(gel.num_vertices());
  if (positions.shape.size() != 3 || positions.shape[2] != 3 || positions.shape[0] == 0) {
    std::string shape;
    for (const std::size_t length : positions.shape) shape += (shape.empty() ? "" : ", ") + std::to_string(length);
    throw DataError("{}: has shape ({}) where (frames, vertices, 3) is needed", name, shape);
  }
  if (positions.shape[1] != num_vertices) {
    throw DataError("{}: has {} vertices, the gel {}", name, positions.shape[1], num_vertices);
  }
  for (std::size_t i = 0; i < positions.data.size(); ++i) {
    if (!std::isfinite(positions.data[i])) {
      throw DataError("{}: frame {}, vertex {} is not finite", name, i / (3 * num_vertices), i / 3 % num_vertices);
    }
  }
  const Positions first = frame_positions(positions, 0);
  Eigen::Index worst = 0;
  const double distance = (first - gel.positions).rowwise().norm().maxCoeff(&worst);
  if (distance > 1e-6) {
    throw DataError("{}: frame 0 is not the gel at rest: vertex {} is {:.3g} mm away from its place in the gel", name,
                    worst, 1e3 * distance);
  }
}

ByteImage read_reference(const std::filesystem::path& path, const Camera& camera) {
  ByteImage image = read_png(path, 3);
  if (image.width != camera.width_px || image.height != camera.height_px) {
    throw DataError("{}: the reference image has {} x {} pixels, the sensor's camera {} x {}", path.string(),
                    image.width, image.height, camera.width_px, camera.height_px);
  }
  return image;
}

ByteImage indentation_picture(const FloatImage& indentation) {
  return picture_of_scalar(indentation, 0.0, std::max(1e-6, largest(indentation)));
}

RenderSummary render(const Sensor& sensor, const RenderConfig& config, const TetMesh& gel, const NpyArray& positions,
                     const std::optional<ByteImage>& reference,
                     const std::function<void(const RenderedFrame&)>& deliver) {
  RenderSummary summary;
  const std::size_t last = positions.shape[0] - 1;
  if (config.all_frames) {
    for (std::size_t frame = 0; frame <= last; ++frame) summary.frames.push_back(frame);
  } else {
    summary.frames = last == 0 ? std::vector<std::size_t>{0} : std::vector<std::size_t>{0, last};
  }
  FloatImage reference_codes;
  ByteImage reference_image;
  for (const std::size_t index : summary.frames) {
    const Membrane membrane = make_membrane(gel, index == 0 ? gel.positions : frame_positions(positions, index));
    RenderedFrame frame;
    frame.index = index;
    frame.trace = trace(membrane, sensor, config.trace);
    frame.linear = color_image(frame.trace.basis, sensor);
    if (index == 0) {
      warn_of_dark_leds(frame.trace.basis);
      summary.exposure = solve_exposure(frame.linear, sensor.response);
      reference_codes = encode(frame.linear, summary.exposure, sensor.response);
      reference_image =
          reference ? *reference : synthetic_reference(frame.linear, summary.exposure, sensor.response, config.noise);
      summary.reference_mean_code = mean_of(reference_image);
    }
    frame.tactile =
        transfer_noise(reference_image, encode(frame.linear, summary.exposure, sensor.response), reference_codes);
    summary.clipped_fraction = std::max(summary.clipped_fraction, frame.tactile.clipped_fraction);
    summary.rays += frame.trace.rays;
    summary.nudged_rays += frame.trace.nudged_rays;
    summary.outside_rays += frame.trace.outside_rays;
    summary.max_indentation_m = largest(frame.trace.indentation);
    log_info("frame {}: deepest indentation {:.3f} mm, {:.2f} % clipped", index, 1e3 * summary.max_indentation_m,
             100.0 * frame.tactile.clipped_fraction);
    deliver(frame);
  }
  return summary;
}

}  // namespace tacipc
