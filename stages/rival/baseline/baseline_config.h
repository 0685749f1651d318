// Content of configs/rivals/baseline/*.yaml.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"
#include "common/config/config.h"
#include "stages/rival/baseline/object_depth.h"

namespace tacipc {

/// Size of a Gaussian g(n, σ), px.
struct GaussianSize {
  int size_px = 0;
  double sigma_px = 0.0;
};

/// OpenCV's Gaussian window of n pixels (odd) without a σ, on pixels 1/factor times as large; see window_profile
/// (kernel.h).
struct GaussianWindow {
  int size_px = 0;
  double factor = 1.0;
};

/// Computes the membrane from the object's depth alone.
struct DeformationConfig {
  enum class Method { difference_of_gaussians, exponential_kernel, two_gaussians, pyramid, rigid, none };
  Method method = Method::difference_of_gaussians;
  GaussianSize near_kernel;  // k1; this and the next three values: only for methods with two Gaussians
  GaussianSize far_kernel;   // k2
  int iterations = 0;
  int far_iterations = 0;                // iterations of k2, two_gaussians only
  double exponential_factor = 1.0;       // f of the exponential kernel
  std::optional<int> designed_width_px;  // width of the images for which the kernels were made; absent: no scaling
  std::vector<GaussianWindow>
      levels;  // levels of the pyramid, px of the images for which it was made; the last one blurs the result
  double contact_share = 0.0;     // fraction of the press depth; pixels less deep do not keep their height
  double designed_pixel_m = 0.0;  // pixel size of those images

  static DeformationConfig read(ConfigReader& in);
  /// Kernels for images `width_px` wide. n and σ scale with the width; n is rounded to the nearest size of the same
  /// parity, at least 1. Pyramid levels scale to pixels of `pixel_m`.
  DeformationConfig scaled_to(int width_px, double pixel_m) const;
};

/// TACTO's depth for a contact force: the object moves towards the camera by min(F, F_largest) / F_largest of the
/// deepest depth.
struct ForceDepth {
  double applied_n = 0.0;
  double largest_n = 0.0;
  double deepest_m = 0.0;

  static ForceDepth read(ConfigReader& in);
  double depth_m() const;
  /// Displacement of an object whose frame has its origin at `object`.
  /// \pre the origin is not at the camera
  Vector3 way_m(const Vector3& object, const Vector3& camera) const;
};

/// One light of the Phong model. The direction is not normalised; x points along columns and y along rows, as for the
/// normals of phong.h.
struct PhongLight {
  std::array<double, 3> direction{};
  std::array<double, 3> rgb{};  // 0 … 255
  double diffuse = 0.0;
  double specular = 0.0;  // specular coefficient, `phong` only
};

/// Phong shading over a photograph (phong.h).
struct PhongConfig {
  double ambient = 0.0;  // factor of the background
  int shininess = 0;     // exponent of the reflected light towards the camera
  double metres_per_pixel = 0.0;
  double gel_thickness_m = 0.0;       // indentation at which darkening reaches black
  bool darkened_by_membrane = false;  // darkening by the membrane's indentation; false: by the object's protrusion
  std::optional<GaussianSize> final_blur;
  std::vector<PhongLight> lights;  // lights, blended in this order

  static PhongConfig read(ConfigReader& in);
};

/// Light that is added to the photograph as a change of grey levels (change.h).
struct ChangeConfig {
  enum class Model { lambert_sum, metallic_roughness, table, network, light_field };
  Model model = Model::lambert_sum;
  double metres_per_pixel = 0.0;   // lambert_sum only, like the next two
  std::vector<PhongLight> lights;  // lights, whose contributions are summed
  std::optional<GaussianSize> blur;
  std::optional<GaussianWindow>
      window;  // metallic_roughness only: blur of the change, px of images with pixels of `designed_pixel_m`
  double designed_pixel_m = 0.0;
  double noise_codes = 0.0;    // standard deviation per pixel and channel of the finished image
  double final_blur_px = 0.0;  // σ of a last blur of the change, as for a light field

  bool needs_light() const { return model != Model::lambert_sum; }
  static ChangeConfig read(ConfigReader& in, const std::string& model);
};

/// Configuration of baseline.
struct BaselineConfig {
  std::optional<double> front_depth_m;  // distance of the undeformed front from the camera; absent: from the sensor
  ObjectRays rays = ObjectRays::refracted;
  std::optional<ForceDepth> force;
  DeformationConfig deformation;
  double texture_sigma_m = 0.0;  // standard deviation of the membrane's height
  std::uint64_t seed = 0;
  std::optional<PhongConfig> phong;  // at most one of `phong` and `change`; neither: only the height map
  std::optional<ChangeConfig> change;

  bool shades() const { return phong || change; }
  static BaselineConfig read(ConfigReader& in);
};

}  // namespace tacipc
