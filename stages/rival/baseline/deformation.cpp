#include "stages/rival/baseline/deformation.h"

#include <algorithm>
#include <cassert>

#include "common/base/rng.h"
#include "stages/rival/baseline/kernel.h"

namespace tacipc {
namespace {

double maximum(const Raster& raster) { return *std::ranges::max_element(raster.values); }

/// S(f, k) of the header: blur, rescale to the full depth, and take the maximum with the object.
Raster smeared(const Raster& f, const Raster& kernel, const Raster& h) {
  Raster out = correlate(f, kernel);
  const double top = maximum(out);
  const double factor = top == 0.0 ? 1.0 : maximum(h) / top;
  for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] = std::max(out.values[i] * factor, h.values[i]);
  return out;
}

Raster difference_of_gaussians(const Raster& h, const DeformationConfig& config) {
  const Raster near_kernel = folded_gaussian(config.near_kernel.size_px, config.near_kernel.sigma_px);
  const Raster far_kernel = folded_gaussian(config.far_kernel.size_px, config.far_kernel.sigma_px);
  Raster a = h, b = h;
  for (int i = 0; i < config.iterations; ++i) a = smeared(a, near_kernel, h);
  for (int i = 0; i < config.iterations; ++i) b = smeared(b, far_kernel, h);
  for (int i = 0; i < config.iterations; ++i) b = smeared(b, near_kernel, h);
  for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] = 2.0 * a.values[i] - b.values[i];
  return a;
}

/// Applies M of the header `times` times.
Raster raised(const Raster& h, const std::vector<double>& profile, int times) {
  Raster f = h;
  for (int i = 0; i < times; ++i) {
    f = correlate_separable(f, profile);
    for (std::size_t k = 0; k < f.values.size(); ++k) f.values[k] = std::max(f.values[k], h.values[k]);
  }
  return f;
}

Raster two_gaussians(const Raster& h, const DeformationConfig& config) {
  const auto near_profile = folded_gaussian_profile(config.near_kernel.size_px, config.near_kernel.sigma_px);
  const auto far_profile = folded_gaussian_profile(config.far_kernel.size_px, config.far_kernel.sigma_px);
  Raster f = raised(h, near_profile, config.iterations);
  const Raster far = raised(h, far_profile, config.far_iterations);
  for (std::size_t i = 0; i < f.values.size(); ++i) f.values[i] = 2.0 * f.values[i] - far.values[i];
  return correlate_separable(f, near_profile);
}

Raster pyramid(const Raster& h, const DeformationConfig& config, double pressed_m) {
  const std::vector<bool> held = held_pixels(h, config, pressed_m);
  Raster f = h;
  for (std::size_t level = 0; level < config.levels.size(); ++level) {
    f = correlate_separable(f, window_profile(config.levels[level].size_px, config.levels[level].factor));
    if (level + 1 == config.levels.size()) break;
    for (std::size_t i = 0; i < f.values.size(); ++i)
      if (held[i]) f.values[i] = h.values[i];
  }
  return f;
}

}  // namespace

Raster protrusion(const Raster& depth_m, const Raster& front_depth_m) {
  assert(depth_m.values.size() == front_depth_m.values.size());
  Raster h(depth_m.width, depth_m.height);
  for (std::size_t i = 0; i < h.values.size(); ++i) {
    const double in = front_depth_m.values[i] - depth_m.values[i];
    h.values[i] = in > 0.0 ? in : 0.0;  // NaN compares as false
  }
  return h;
}

std::vector<bool> held_pixels(const Raster& protrusion_m, const DeformationConfig& config, double pressed_m) {
  const double least = config.contact_share * std::max(pressed_m, maximum(protrusion_m));
  std::vector<bool> held;
  for (const double height : protrusion_m.values) held.push_back(height > least);
  return held;
}

Raster membrane_indentation(const Raster& protrusion_m, const DeformationConfig& config, double pressed_m) {
  switch (config.method) {
    case DeformationConfig::Method::difference_of_gaussians: return difference_of_gaussians(protrusion_m, config);
    case DeformationConfig::Method::exponential_kernel:
      // The kernel's sum is 1, so padding the depth with the front's depth is padding the protrusion with zero.
      return correlate(protrusion_m, exponential_kernel(config.exponential_factor), Border::constant, 0.0);
    case DeformationConfig::Method::two_gaussians: return two_gaussians(protrusion_m, config);
    case DeformationConfig::Method::pyramid: return pyramid(protrusion_m, config, pressed_m);
    case DeformationConfig::Method::rigid:
    case DeformationConfig::Method::none: return protrusion_m;
  }
  return protrusion_m;
}

void add_texture(Raster& depth_m, double sigma_m, std::uint64_t seed) {
  if (sigma_m == 0.0) return;
  constexpr std::uint64_t kTextureStream = 0x74657874;  // "text"
  for (std::size_t i = 0; i < depth_m.values.size(); ++i)
    depth_m.values[i] += sigma_m * random_normal(seed, kTextureStream, i);
}

}  // namespace tacipc
