// configs/rivals/baseline/*.yaml
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// g(n, σ) in pixels.
struct GaussianSize {
  int size_px = 0;
  double sigma_px = 0.0;
};

/// How the membrane follows from the object's depth alone.
struct DeformationConfig {
  enum class Method { difference_of_gaussians, exponential_kernel, none };
  Method method = Method::difference_of_gaussians;
  GaussianSize near_kernel;  // k1 [difference of Gaussians only, as what follows]
  GaussianSize far_kernel;   // k2
  int iterations = 0;
  double exponential_factor = 1.0;       // f of the exponential kernel
  std::optional<int> designed_width_px;  // of the images the kernels were made for; absent: taken as they are

  static DeformationConfig read(ConfigReader& in);
  /// Kernels for images `width_px` wide: n and σ scale with the width, n to the nearest of the same parity and at least
  /// 1.
  DeformationConfig scaled_to(int width_px) const;
};

/// One light of the Phong model. The direction (x along columns, y along rows as the normals of phong.h) is not
/// normalised.
struct PhongLight {
  std::array<double, 3> direction{};
  std::array<double, 3> rgb{};  // 0 … 255
  double diffuse = 0.0;
  double specular = 0.0;
};

struct PhongConfig {
  double ambient = 0.0;  // of the background
  int shininess = 0;     // power of the reflected light's share towards the camera
  double metres_per_pixel = 0.0;
  double gel_thickness_m = 0.0;  // over which the protrusion goes over to black
  std::optional<GaussianSize> final_blur;
  std::vector<PhongLight> lights;  // laid over each other in this order

  static PhongConfig read(ConfigReader& in);
};

struct BaselineConfig {
  std::optional<double> front_depth_m;  // of the undeformed front from the camera; absent: the sensor's
  DeformationConfig deformation;
  double texture_sigma_m = 0.0;  // of the membrane's height, normally distributed
  std::uint64_t seed = 0;
  std::optional<PhongConfig> shading;  // absent: the height map alone

  static BaselineConfig read(ConfigReader& in);
};

}  // namespace tacipc
