#include "stages/rival/baseline/change.h"

#include <algorithm>

#include "common/base/rng.h"
#include "stages/rival/baseline/kernel.h"
#include "stages/rival/baseline/phong.h"
#include "stages/rival/baseline/shadows.h"
#include "stages/rival/baseline/taxim_table.h"

namespace tacipc {
namespace {

std::array<int, 3> lambert_codes(const std::vector<PhongLight>& lights, const std::array<double, 3>& normal) {
  std::array<int, 3> codes{};
  for (const PhongLight& light : lights) {
    const auto& l = light.direction;
    const double d = std::max(normal[0] * l[0] + normal[1] * l[1] + normal[2] * l[2], 0.0);
    for (std::size_t c = 0; c < 3; ++c)
      codes[c] = static_cast<int>(std::clamp(codes[c] + light.diffuse * d * light.rgb[c], 0.0, 255.0));
  }
  return codes;
}

}  // namespace

RivalLight read_light(const std::filesystem::path& file, ChangeConfig::Model model, const Camera& camera) {
  switch (model) {
    case ChangeConfig::Model::lambert_sum: break;
    case ChangeConfig::Model::metallic_roughness: return read_config<MetallicLamps>(file);
    case ChangeConfig::Model::table:
      return file.extension() == ".npz" ? read_taxim_table(file, camera.width_px, camera.height_px)
                                        : SlopeTable::read(file);
    case ChangeConfig::Model::network: return LightNetwork::read(file);
    case ChangeConfig::Model::light_field: return read_config<LightField>(file);
  }
  return {};
}

ChangeOfCodes::ChangeOfCodes(const ChangeConfig& config, const RivalLight& light, const Sensor& sensor,
                             std::optional<ShadowTable> shadows, double shadow_pixel_m)
    : config_(config),
      light_(light),
      sensor_(sensor),
      shadows_(std::move(shadows)),
      shadow_pixel_m_(shadow_pixel_m),
      pixel_m_(sensor.camera.window_width_m / sensor.camera.width_px) {
  const Camera& camera = sensor.camera;
  if (std::holds_alternative<MetallicLamps>(light_)) {
    const MembraneView flat = flat_view(CameraModel(camera, sensor.stack), camera);
    for (const Vector3& point : flat.rest) empty_.push_back(metallic_codes(point, -Vector3::UnitZ()));
  }
  if (std::holds_alternative<LightNetwork>(light_)) {
    const std::vector<double> level(camera.width_px, 0.0);
    for (int y = 0; y < camera.height_px; ++y) flat_.push_back(network_row(y, level.data(), level.data()));
  }
}

FloatImage ChangeOfCodes::operator()(const Raster& indentation_m, const std::vector<Vector3>& object_normal,
                                     const std::vector<bool>& held) const {
  FloatImage change;
  switch (config_.model) {
    case ChangeConfig::Model::lambert_sum: change = lambert(indentation_m); break;
    case ChangeConfig::Model::metallic_roughness: change = metallic(indentation_m, object_normal); break;
    case ChangeConfig::Model::table: change = table(indentation_m); break;
    case ChangeConfig::Model::network: change = network(indentation_m); break;
    case ChangeConfig::Model::light_field:
      change = code_change(std::get<LightField>(light_), view_height_map(to_image(indentation_m), sensor_));
      break;
  }
  if (shadows_) cast_shadows(change, *shadows_, indentation_m, held, pixel_m_, shadow_pixel_m_ / pixel_m_);
  return gaussian_blurred(change, config_.final_blur_px);
}

FloatImage ChangeOfCodes::lambert(const Raster& indentation_m) const {
  Raster depth = indentation_m;  // depth relative to the camera: a deeper point in the gel is farther away
  for (double& value : depth.values) value = -value;
  const std::array<int, 3> flat = lambert_codes(config_.lights, {0.0, 0.0, 1.0});
  FloatImage change(depth.width, depth.height, 3);
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const auto codes = lambert_codes(config_.lights, phong_normal(depth, config_.metres_per_pixel, x, y));
      for (int c = 0; c < 3; ++c) {
        change.at(x, y, c) = static_cast<float>(codes[c] - flat[c]);
      }
    }
  }
  return config_.blur
             ? correlate_channels(change, folded_gaussian_profile(config_.blur->size_px, config_.blur->sigma_px))
             : change;
}

std::array<double, 3> ChangeOfCodes::metallic_codes(const Vector3& point, const Vector3& normal) const {
  std::array<double, 3> light{};
  for (const MetallicLamp& lamp : std::get<MetallicLamps>(light_).lamps) {
    const double white = metallic_light(point, normal, sensor_.camera.position_m, lamp.position_m);
    for (std::size_t c = 0; c < 3; ++c) light[c] += lamp.rgb[c] * white;
  }
  return {metallic_code(light[0]), metallic_code(light[1]), metallic_code(light[2])};
}

FloatImage ChangeOfCodes::metallic(const Raster& indentation_m, const std::vector<Vector3>& object_normal) const {
  const MembraneView view = view_height_map(to_image(indentation_m), sensor_);
  const double factor = std::get<MetallicLamps>(light_).change_factor;
  FloatImage change(view.width, view.height, 3);
  for (std::size_t i = 0; i < view.point.size(); ++i) {
    const bool rigid = !object_normal.empty() && object_normal[i] != Vector3::Zero();
    const Vector3 normal = rigid ? object_normal[i] : Vector3(-view.normal[i]);
    // A flat front next to a rigid object does not change, regardless of the map's slope at the edge.
    const bool flat = !object_normal.empty() && !rigid;
    const auto codes = flat ? empty_[i] : metallic_codes(view.point[i], normal);
    for (std::size_t c = 0; c < 3; ++c)
      change.pixels[3 * i + c] = static_cast<float>(factor * (codes[c] - empty_[i][c]));
  }
  if (!config_.window) return change;
  return correlate_channels(change, window_profile(config_.window->size_px, config_.designed_pixel_m / pixel_m_));
}

FloatImage ChangeOfCodes::table(const Raster& indentation_m) const {
  const auto& table = std::get<SlopeTable>(light_);
  const Slopes slopes = slopes_of(indentation_m, pixel_m_);
  FloatImage change(indentation_m.width, indentation_m.height, 3);
  for (int y = 0; y < change.height; ++y) {
    for (int x = 0; x < change.width; ++x) {
      const auto codes =
          table.change(slopes.x.at(x, y), slopes.y.at(x, y), SlopeTable::terms(x, y, change.width, change.height));
      for (int c = 0; c < 3; ++c) change.at(x, y, c) = static_cast<float>(codes[c]);
    }
  }
  return change;
}

Eigen::MatrixXf ChangeOfCodes::network_row(int y, const double* slope_x, const double* slope_y) const {
  const Camera& camera = sensor_.camera;
  Eigen::MatrixXf inputs(5, camera.width_px);
  for (int x = 0; x < camera.width_px; ++x) {
    const auto input = LightNetwork::input(x, y, camera.width_px, camera.height_px, slope_x[x], slope_y[x]);
    inputs.col(x) = Eigen::Map<const Eigen::Matrix<float, 5, 1>>(input.data());
  }
  return std::get<LightNetwork>(light_).forward(inputs);
}

FloatImage ChangeOfCodes::network(const Raster& indentation_m) const {
  const Slopes slopes = slopes_of(indentation_m, pixel_m_);
  FloatImage change(indentation_m.width, indentation_m.height, 3);
  for (int y = 0; y < change.height; ++y) {
    const auto row = static_cast<std::size_t>(y) * change.width;
    const Eigen::MatrixXf codes = 255.0F * (network_row(y, &slopes.x.values[row], &slopes.y.values[row]) - flat_[y]);
    std::copy(codes.data(), codes.data() + codes.size(), &change.pixels[3 * row]);
  }
  return change;
}

void add_noise(ByteImage& image, double sigma_codes, std::uint64_t seed) {
  if (sigma_codes == 0.0) return;
  constexpr std::uint64_t kNoiseStream = 0x6e6f6973;  // "nois"
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::uint8_t>(
        std::clamp(image.pixels[i] + sigma_codes * random_normal(seed, kNoiseStream, i), 0.0, 255.0));
}

}  // namespace tacipc
