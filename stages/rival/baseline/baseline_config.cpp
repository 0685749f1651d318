#include "stages/rival/baseline/baseline_config.h"

#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

constexpr int kLargestKernel = 1001;

GaussianSize read_gaussian(ConfigReader in) {
  return {.size_px = in.integer("size_px", 1, kLargestKernel),
          .sigma_px = in.number("sigma_px", {.low = 0.1, .high = 1e3})};
}

GaussianSize scaled(const GaussianSize& kernel, double factor) {
  // Odd sizes have a centre pixel, even ones none: the parity decides whether the kernel is symmetric.
  const int parity = kernel.size_px % 2;
  const int half = static_cast<int>(std::lround((kernel.size_px * factor - parity) / 2.0));
  return {.size_px = std::max(1, 2 * half + parity), .sigma_px = kernel.sigma_px * factor};
}

GaussianWindow read_window(ConfigReader& in) {
  const int size = in.integer("size_px", 3, kLargestKernel);
  if (size % 2 == 0) in.fault("size_px", "expected an odd number");
  return {.size_px = size};
}

PhongLight read_light(ConfigReader& in) {
  PhongLight light;
  const auto direction = in.numbers("direction", 3), rgb = in.numbers("rgb", 3, Range::between(0.0, 255.0));
  std::ranges::copy(direction, light.direction.begin());
  std::ranges::copy(rgb, light.rgb.begin());
  light.diffuse = in.number("diffuse", Range::non_negative());
  return light;
}

}  // namespace

DeformationConfig DeformationConfig::read(ConfigReader& in) {
  DeformationConfig config;
  static const std::vector<std::string> kMethods{
      "difference_of_gaussians", "exponential_kernel", "two_gaussians", "pyramid", "rigid", "none"};
  config.method = static_cast<Method>(std::ranges::find(kMethods, in.choice("method", kMethods)) - kMethods.begin());
  if (config.method == Method::none || config.method == Method::rigid) return config;
  if (config.method == Method::pyramid) {
    config.designed_pixel_m = 1e-3 * in.number("designed_mm_per_px", Range::positive());
    config.contact_share = in.number("contact_share", Range::between(0.0, 1.0));
    for (ConfigReader& level : in.one_or_more_sections("levels")) config.levels.push_back(read_window(level));
    return config;
  }
  if (in.has("designed_width_px")) config.designed_width_px = in.integer("designed_width_px", 1, 16384);
  if (config.method == Method::exponential_kernel) return config;
  config.near_kernel = read_gaussian(in.section("near_kernel"));
  config.far_kernel = read_gaussian(in.section("far_kernel"));
  config.iterations = in.integer("iterations", 1, 100);
  if (config.method == Method::two_gaussians) config.far_iterations = in.integer("far_iterations", 1, 100);
  return config;
}

DeformationConfig DeformationConfig::scaled_to(int width_px, double pixel_m) const {
  DeformationConfig out = *this;
  for (GaussianWindow& level : out.levels) level.factor = designed_pixel_m / pixel_m;
  if (!designed_width_px) return out;
  const double factor = static_cast<double>(width_px) / *designed_width_px;
  out.exponential_factor = exponential_factor * factor;
  if (method == Method::exponential_kernel) return out;
  out.near_kernel = scaled(near_kernel, factor);
  out.far_kernel = scaled(far_kernel, factor);
  return out;
}

ForceDepth ForceDepth::read(ConfigReader& in) {
  return {.applied_n = in.number("applied_n", Range::non_negative()),
          .largest_n = in.number("largest_n", Range::positive()),
          .deepest_m = 1e-3 * in.number("deepest_mm", Range::positive())};
}

double ForceDepth::depth_m() const { return std::min(applied_n, largest_n) / largest_n * deepest_m; }

Vector3 ForceDepth::way_m(const Vector3& object, const Vector3& camera) const {
  return depth_m() * (camera - object).normalized();
}

PhongConfig PhongConfig::read(ConfigReader& in) {
  PhongConfig config;
  config.ambient = in.number("ambient", Range::non_negative());
  config.shininess = in.integer("shininess", 0, 1000);
  config.metres_per_pixel = in.number("metres_per_pixel", Range::positive());
  config.gel_thickness_m = 1e-3 * in.number("gel_thickness_mm", Range::positive());
  config.darkened_by_membrane = in.choice_or("darkened_by", "object", {"object", "membrane"}) == "membrane";
  if (auto blur = in.optional_section("final_blur")) config.final_blur = read_gaussian(*blur);
  for (ConfigReader& item : in.one_or_more_sections("lights")) {
    PhongLight light = read_light(item);
    light.specular = item.number("specular", Range::non_negative());
    config.lights.push_back(light);
  }
  return config;
}

ChangeConfig ChangeConfig::read(ConfigReader& in, const std::string& model) {
  ChangeConfig config;
  if (model == "lambert_sum") {
    config.metres_per_pixel = in.number("metres_per_pixel", Range::positive());
    for (ConfigReader& item : in.one_or_more_sections("lights")) config.lights.push_back(read_light(item));
    if (auto blur = in.optional_section("blur")) config.blur = read_gaussian(*blur);
  } else if (model == "metallic_roughness") {
    config.model = Model::metallic_roughness;
    if (auto window = in.optional_section("window")) {
      config.window = read_window(*window);
      config.designed_pixel_m = 1e-3 * window->number("designed_mm_per_px", Range::positive());
    }
  } else {
    config.model = model == "table" ? Model::table : model == "network" ? Model::network : Model::light_field;
  }
  config.noise_codes = in.number_or("noise_codes", 0.0, Range::non_negative());
  config.final_blur_px = in.number_or("final_blur_px", 0.0, Range::between(0.0, 100.0));
  return config;
}

BaselineConfig BaselineConfig::read(ConfigReader& in) {
  BaselineConfig config;
  static const std::vector<std::string> kRays{"refracted", "straight", "parallel"};
  config.rays =
      static_cast<ObjectRays>(std::ranges::find(kRays, in.choice_or("rays", kRays[0], kRays)) - kRays.begin());
  if (auto force = in.optional_section("contact_force")) config.force = ForceDepth::read(*force);
  if (const auto depth = in.optional_number("front_depth_mm", Range::positive())) config.front_depth_m = 1e-3 * *depth;
  config.deformation = in.read<DeformationConfig>("deformation");
  config.texture_sigma_m = 1e-3 * in.number("texture_sigma_mm", Range::non_negative());
  config.seed = static_cast<std::uint64_t>(in.integer_or("seed", 1, 0));
  if (auto shading = in.optional_section("shading")) {
    const std::string model = shading->choice_or(
        "model", "phong", {"phong", "lambert_sum", "metallic_roughness", "table", "network", "light_field"});
    if (model == "phong")
      config.phong = PhongConfig::read(*shading);
    else
      config.change = ChangeConfig::read(*shading, model);
  }
  return config;
}

}  // namespace tacipc
