// Light of simulators that add a change of grey levels to the photograph without contact.
#pragma once

#include <filesystem>
#include <optional>
#include <variant>
#include <vector>

#include "common/image/image.h"
#include "common/rival/light_network.h"
#include "common/rival/metallic_lamps.h"
#include "common/rival/shadow_table.h"
#include "common/rival/slope_table.h"
#include "common/sensor/light_field.h"
#include "common/sensor/membrane_view.h"
#include "common/sensor/sensor.h"
#include "stages/rival/baseline/baseline_config.h"
#include "stages/rival/baseline/raster.h"

namespace tacipc {

/// Light from `calibrate` or from a file; empty if the configuration lists the lights.
using RivalLight = std::variant<std::monostate, MetallicLamps, SlopeTable, LightNetwork, LightField>;
/// Reads a light.
/// \param camera camera of the image, for tables in its pixels
/// \throw DataError, ConfigError if the file is not a light of this model
RivalLight read_light(const std::filesystem::path& file, ChangeConfig::Model model, const Camera& camera);

/// Computes changes of grey levels for one sensor. Everything independent of the membrane is computed once.
class ChangeOfCodes {
 public:
  /// \param shadows shadows of a table's contacts, measured in pixels of `shadow_pixel_m`
  /// \pre the light is of the model's kind
  ChangeOfCodes(const ChangeConfig& config, const RivalLight& light, const Sensor& sensor,
                std::optional<ShadowTable> shadows = std::nullopt, double shadow_pixel_m = 0.0);

  /// Change of grey levels for a membrane:
  /// - lambert_sum: Σ k_d max(N · L, 0) colour over normals (−dz/dx, −dz/dy, 1) / |…| of depth / metres_per_pixel,
  /// truncated to whole levels of 0 … 255 after each light, minus the same of a flat gel; then g(n, σ).
  /// - metallic_roughness: factor × (rendered level − level without object), then the window.
  /// - table, network: function of the slopes of the height map from straight above; for the network minus its
  /// prediction for a flat gel.
  /// - light_field: the change of light_field.h, with the blur that belongs to it.
  /// Then the shadows of the pixels `held` follow, if there are any, and final_blur_px comes last.
  /// \param object_normal normals of a rigid object where it is in the gel, zero elsewhere; or empty
  FloatImage operator()(const Raster& indentation_m, const std::vector<Vector3>& object_normal,
                        const std::vector<bool>& held = {}) const;

 private:
  FloatImage lambert(const Raster& indentation_m) const;
  FloatImage metallic(const Raster& indentation_m, const std::vector<Vector3>& object_normal) const;
  FloatImage table(const Raster& indentation_m) const;
  FloatImage network(const Raster& indentation_m) const;
  std::array<double, 3> metallic_codes(const Vector3& point, const Vector3& normal) const;
  Eigen::MatrixXf network_row(int y, const double* slope_x, const double* slope_y) const;

  ChangeConfig config_;
  RivalLight light_;
  Sensor sensor_;
  std::optional<ShadowTable> shadows_;
  double shadow_pixel_m_;
  double pixel_m_;
  std::vector<std::array<double, 3>> empty_;  // metallic: grey levels without object
  std::vector<Eigen::MatrixXf> flat_;         // network: predictions for a flat gel, row by row
};

/// Adds noise N(0, σ) to every grey level, which depends only on seed, pixel and channel, and truncates it to 0 … 255.
void add_noise(ByteImage& image, double sigma_codes, std::uint64_t seed);

}  // namespace tacipc
