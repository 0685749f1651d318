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

}  // namespace

DeformationConfig DeformationConfig::read(ConfigReader& in) {
  DeformationConfig config;
  const std::string method = in.choice("method", {"difference_of_gaussians", "exponential_kernel", "none"});
  if (method == "none") config.method = Method::none;
  if (method == "exponential_kernel") config.method = Method::exponential_kernel;
  if (config.method == Method::none) return config;
  if (in.has("designed_width_px")) config.designed_width_px = in.integer("designed_width_px", 1, 16384);
  if (config.method == Method::exponential_kernel) return config;
  config.near_kernel = read_gaussian(in.section("near_kernel"));
  config.far_kernel = read_gaussian(in.section("far_kernel"));
  config.iterations = in.integer("iterations", 1, 100);
  return config;
}

DeformationConfig DeformationConfig::scaled_to(int width_px) const {
  DeformationConfig out = *this;
  if (!designed_width_px || method == Method::none) return out;
  const double factor = static_cast<double>(width_px) / *designed_width_px;
  out.exponential_factor = exponential_factor * factor;
  if (method == Method::exponential_kernel) return out;
  out.near_kernel = scaled(near_kernel, factor);
  out.far_kernel = scaled(far_kernel, factor);
  return out;
}

PhongConfig PhongConfig::read(ConfigReader& in) {
  PhongConfig config;
  config.ambient = in.number("ambient", Range::non_negative());
  config.shininess = in.integer("shininess", 0, 1000);
  config.metres_per_pixel = in.number("metres_per_pixel", Range::positive());
  config.gel_thickness_m = 1e-3 * in.number("gel_thickness_mm", Range::positive());
  if (auto blur = in.optional_section("final_blur")) config.final_blur = read_gaussian(*blur);
  for (ConfigReader& item : in.one_or_more_sections("lights")) {
    PhongLight light;
    const auto direction = item.numbers("direction", 3), rgb = item.numbers("rgb", 3, Range::between(0.0, 255.0));
    std::copy(direction.begin(), direction.end(), light.direction.begin());
    std::copy(rgb.begin(), rgb.end(), light.rgb.begin());
    light.diffuse = item.number("diffuse", Range::non_negative());
    light.specular = item.number("specular", Range::non_negative());
    config.lights.push_back(light);
  }
  return config;
}

BaselineConfig BaselineConfig::read(ConfigReader& in) {
  BaselineConfig config;
  if (const auto depth = in.optional_number("front_depth_mm", Range::positive())) config.front_depth_m = 1e-3 * *depth;
  ConfigReader deformation = in.section("deformation");
  config.deformation = DeformationConfig::read(deformation);
  config.texture_sigma_m = 1e-3 * in.number("texture_sigma_mm", Range::non_negative());
  config.seed = static_cast<std::uint64_t>(in.integer_or("seed", 1, 0));
  if (auto shading = in.optional_section("shading")) config.shading = PhongConfig::read(*shading);
  return config;
}

}  // namespace tacipc
