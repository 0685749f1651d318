// configs/rivals/baseline/*.yaml
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

/// g(n, σ) in pixels.
struct GaussianSize {
  int size_px = 0;
  double sigma_px = 0.0;
};

/// OpenCV's Gaussian window of n pixels (odd) without a σ, on pixels 1/factor times as large: window_profile
/// (kernel.h).
struct GaussianWindow {
  int size_px = 0;
  double factor = 1.0;
};

/// How the membrane follows from the object's depth alone.
struct DeformationConfig {
  enum class Method { difference_of_gaussians, exponential_kernel, two_gaussians, pyramid, rigid, none };
  Method method = Method::difference_of_gaussians;
  GaussianSize near_kernel;  // k1 [the two with Gaussians only, as what follows]
  GaussianSize far_kernel;   // k2
  int iterations = 0;
  int far_iterations = 0;                // two_gaussians only
  double exponential_factor = 1.0;       // f of the exponential kernel
  std::optional<int> designed_width_px;  // of the images the kernels were made for; absent: taken as they are
  std::vector<GaussianWindow> levels;    // of the pyramid, px of the images it was made for; the last closes it
  double contact_share = 0.0;            // of the depth of the press: what is less deep does not keep its height
  double designed_pixel_m = 0.0;         // of those images

  static DeformationConfig read(ConfigReader& in);
  /// Kernels for images `width_px` wide: n and σ scale with the width, n to the nearest of the same parity and at least
  /// 1. Those of the pyramid for pixels of `pixel_m`.
  DeformationConfig scaled_to(int width_px, double pixel_m) const;
};

/// TACTO's depth of a contact force: the object goes towards the camera by min(F, F_largest) / F_largest of the
/// deepest.
struct ForceDepth {
  double applied_n = 0.0;
  double largest_n = 0.0;
  double deepest_m = 0.0;

  static ForceDepth read(ConfigReader& in);
  double depth_m() const;
  /// The way of an object whose frame's origin is at `object`. \pre it is not at the camera
  Vector3 way_m(const Vector3& object, const Vector3& camera) const;
};

/// One light of the Phong model. The direction (x along columns, y along rows as the normals of phong.h) is not
/// normalised.
struct PhongLight {
  std::array<double, 3> direction{};
  std::array<double, 3> rgb{};  // 0 … 255
  double diffuse = 0.0;
  double specular = 0.0;  // of `phong` only
};

struct PhongConfig {
  double ambient = 0.0;  // of the background
  int shininess = 0;     // power of the reflected light's share towards the camera
  double metres_per_pixel = 0.0;
  double gel_thickness_m = 0.0;       // over which what darkens goes over to black
  bool darkened_by_membrane = false;  // by the membrane's indentation instead of the object's protrusion
  std::optional<GaussianSize> final_blur;
  std::vector<PhongLight> lights;  // laid over each other in this order

  static PhongConfig read(ConfigReader& in);
};

/// Light that is added to the photograph as a change of codes (change.h).
struct ChangeConfig {
  enum class Model { lambert_sum, metallic_roughness, table, network, light_field };
  Model model = Model::lambert_sum;
  double metres_per_pixel = 0.0;   // lambert_sum only, as what follows
  std::vector<PhongLight> lights;  // added up
  std::optional<GaussianSize> blur;
  std::optional<GaussianWindow> window;  // metallic_roughness only: of the change, px of images of designed_pixel_m
  double designed_pixel_m = 0.0;
  double noise_codes = 0.0;    // standard deviation per pixel and channel of the finished image
  double final_blur_px = 0.0;  // σ of a last blur of the change, as a light field's

  bool needs_light() const { return model != Model::lambert_sum; }
  static ChangeConfig read(ConfigReader& in, const std::string& model);
};

struct BaselineConfig {
  std::optional<double> front_depth_m;  // of the undeformed front from the camera; absent: the sensor's
  ObjectRays rays = ObjectRays::refracted;
  std::optional<ForceDepth> force;
  DeformationConfig deformation;
  double texture_sigma_m = 0.0;  // of the membrane's height, normally distributed
  std::uint64_t seed = 0;
  std::optional<PhongConfig> phong;  // at most one of the two; neither: the height map alone
  std::optional<ChangeConfig> change;

  bool shades() const { return phong || change; }
  static BaselineConfig read(ConfigReader& in);
};

}  // namespace tacipc
