// Light of simulators that add a change of codes to the photograph without contact.
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

/// What `calibrate` found, or a file says: nothing for lights that the configuration lists.
using RivalLight = std::variant<std::monostate, MetallicLamps, SlopeTable, LightNetwork, LightField>;
/// \param camera for tables in pixels of its image \throw DataError, ConfigError if it is no light of this model
RivalLight read_light(const std::filesystem::path& file, ChangeConfig::Model model, const Camera& camera);

/// Makes changes of codes for one sensor; what does not depend on the membrane is computed once.
class ChangeOfCodes {
 public:
  /// `shadows`: of a table's contacts, measured in pixels of `shadow_pixel_m`. \pre a light of the model's kind
  ChangeOfCodes(const ChangeConfig& config, const RivalLight& light, const Sensor& sensor,
                std::optional<ShadowTable> shadows = std::nullopt, double shadow_pixel_m = 0.0);

  /// `object_normal`: of a rigid object where it is in the gel, zero elsewhere, or none.
  /// - lambert_sum: Σ k_d max(N · L, 0) colour over normals (−dz/dx, −dz/dy, 1) / |…| of depth / metres_per_pixel, cut
  /// to
  ///   whole codes of 0 … 255 after each light, less the same of a flat gel; then g(n, σ).
  /// - metallic_roughness: factor × (code rendered − code without object), then the window.
  /// - table, network: of the slopes of the height map straight from above; the network's answer less that for a flat
  /// gel.
  /// - light_field: that of light_field.h, our own, with the blur that belongs to it.
  /// Shadows of the pixels `held`, if there are any, come next, final_blur_px last of all.
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
  std::vector<std::array<double, 3>> empty_;  // metallic: codes without object
  std::vector<Eigen::MatrixXf> flat_;         // network: answers for a flat gel, row by row
};

/// Adds N(0, σ) to every code, by seed, pixel and channel alone, and cuts it to a whole one of 0 … 255.
void add_noise(ByteImage& image, double sigma_codes, std::uint64_t seed);

}  // namespace tacipc
