// Configuration of rendering: outputs, resolution and variants. Light, camera and coating belong to the sensor.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/optics/trace.h"
#include "common/sample/rendered_frames.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Random deviations of a sensor unit from its nominal values: normal deviates with these standard deviations,
/// determined by the seed.
struct Perturbation {
  int seed = 0;
  double led_position_m = 0.0;       // each coordinate of each LED
  double led_intensity = 0.0;        // relative
  double camera_position_m = 0.0;    // each coordinate
  double camera_rotation_rad = 0.0;  // rotation about each axis (rectified camera: only about z)
  double coating_albedo = 0.0;       // relative, all channels equal

  static Perturbation read(ConfigReader& in);
};

/// Variant: the same deformation with another sensor, other light or another reference.
struct Variant {
  struct Light {
    std::string group;
    std::array<double, 3> rgb{};
  };
  std::string name = {};  // name of its folder inside each frame
  std::optional<std::filesystem::path> sensor =
      std::nullopt;                // sensor file whose optics replace those of the sensor; the gel stays
  std::vector<Light> lights = {};  // light groups with another colour
  std::optional<std::array<double, 3>> coating_albedo = std::nullopt;  // coating of another colour
  std::optional<std::filesystem::path> reference_image = std::nullopt;
  std::optional<Perturbation> perturbation = std::nullopt;

  static Variant read(ConfigReader& in);
  /// True if rays must be traced for it; otherwise the basis images of the sensor suffice.
  bool needs_rays() const { return sensor.has_value() || perturbation.has_value(); }
};

/// Transfer of the reference's noise into the image: on grey levels, as a factor in linear light, or not at all.
enum class Transfer { encoded, linear, none };

/// Configuration of render.
struct RenderConfig {
  RenderedFrames frames = RenderedFrames::last;
  TraceSettings trace;
  bool basis_images = false;  // also write the image of each light group alone
  Transfer transfer = Transfer::encoded;
  std::uint64_t noise_seed = 0;
  bool noise_in_every_frame =
      false;  // add fresh noise in each simulated frame, in addition to the noise of the reference
  std::vector<Variant> variants = {};
  bool linear = true, marker = true;  // images that are made; a dataset may not need them

  static RenderConfig read(ConfigReader& in);
};

/// Noise seed of one sample of a dataset: a hash of the configuration's seed, the sample's and the stage. Samples must
/// not share a noise pattern, because a network could learn that pattern to separate noise from shape.
std::uint64_t noise_seed_of_sample(std::uint64_t noise_seed, std::uint64_t sample_seed);

/// Sensor of a variant. `other` is the variant's sensor file, already read.
/// \throw DataError if it names a light group that the sensor does not have
Sensor varied(const Sensor& sensor, const Variant& variant, const std::optional<Sensor>& other);

}  // namespace tacipc
