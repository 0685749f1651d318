// How to render: what is drawn, how finely, and in which variants. Light, camera and coating belong to the sensor.
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

/// How a sensor unit differs from its drawing: normal deviates with these standard deviations, a function of the seed.
struct Perturbation {
  int seed = 0;
  double led_position_m = 0.0;       // each coordinate of each LED
  double led_intensity = 0.0;        // relative
  double camera_position_m = 0.0;    // each coordinate
  double camera_rotation_rad = 0.0;  // about each axis (a rectified camera: about z)
  double coating_albedo = 0.0;       // relative, all channels alike

  static Perturbation read(ConfigReader& in);
};

/// The same deformation seen by another sensor, in other light or against another reference.
struct Variant {
  struct Light {
    std::string group;
    std::array<double, 3> rgb{};
  };
  std::string name = {};                                               // of its folder inside each frame
  std::optional<std::filesystem::path> sensor = std::nullopt;          // another file's optics on the same gel
  std::vector<Light> lights = {};                                      // groups that shine in another colour
  std::optional<std::array<double, 3>> coating_albedo = std::nullopt;  // gel of another colour
  std::optional<std::filesystem::path> reference_image = std::nullopt;
  std::optional<Perturbation> perturbation = std::nullopt;

  static Variant read(ConfigReader& in);
  /// Whether rays have to be traced for it; otherwise the basis images of the sensor itself do.
  bool needs_rays() const { return sensor.has_value() || perturbation.has_value(); }
};

/// How the noise of the reference gets into the image: on codes, as a factor in linear light, or not at all.
enum class Transfer { encoded, linear, none };

struct RenderConfig {
  RenderedFrames frames = RenderedFrames::last;
  TraceSettings trace;
  bool basis_images = false;  // also the image of each light group alone
  Transfer transfer = Transfer::encoded;
  std::uint64_t noise_seed = 0;
  bool noise_in_every_frame = false;  // fresh noise in each simulated frame, beside what the reference carries
  std::vector<Variant> variants = {};
  bool linear = true, marker = true;  // images that need not be made where a dataset does not want them

  static RenderConfig read(ConfigReader& in);
};

/// Seed of the noise of one sample of a dataset, a hash of the configuration's, the sample's and the stage: samples
/// must not carry the same pattern, which is all that a network would have to learn to tell noise from shape.
std::uint64_t noise_seed_of_sample(std::uint64_t noise_seed, std::uint64_t sample_seed);

/// The sensor that a variant means. `other` is its sensor file, read.
/// \throw DataError if it names a light group that the sensor has not.
Sensor varied(const Sensor& sensor, const Variant& variant, const std::optional<Sensor>& other);

}  // namespace tacipc
