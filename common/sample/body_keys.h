// Keys of a file that say what a body is: the same in a scene and in a robot's task.
#pragma once

#include <optional>
#include <string>

#include "common/base/types.h"
#include "common/config/config.h"

namespace tacipc {

/// A name that is a folder's, too: letters, digits, _ and -.
std::string read_body_name(ConfigReader& in, const std::string& key);

/// Three numbers times `unit`; zero where the key is absent.
Vector3 read_triple(ConfigReader& in, const std::string& key, double unit);
/// A rotation vector in degrees, as rad; zero where the key is absent.
Vector3 read_turn(ConfigReader& in, const std::string& key);

/// One of both.
struct BodyMass {
  std::optional<double> mass_kg = std::nullopt;
  double density_kg_m3 = 0.0;

  /// Of a solid of this volume.
  double mass_of(double volume_m3) const { return mass_kg ? *mass_kg : density_kg_m3 * volume_m3; }
  double density_of(double volume_m3) const { return mass_kg ? *mass_kg / volume_m3 : density_kg_m3; }
};
/// `mass_g` or `density_kg_m3`.
BodyMass read_body_mass(ConfigReader& in);

}  // namespace tacipc
