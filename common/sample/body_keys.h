// Reads the keys that describe a body, shared by scene files and robot tasks.
#pragma once

#include <optional>
#include <string>

#include "common/base/types.h"
#include "common/config/config.h"

namespace tacipc {

/// Reads a name that can also name a folder: letters, digits, _ and -.
std::string read_body_name(ConfigReader& in, const std::string& key);

/// Reads three numbers and multiplies them by `unit`. Zero if the key is absent.
Vector3 read_triple(ConfigReader& in, const std::string& key, double unit);
/// Reads a rotation vector in degrees and returns it in rad. Zero if the key is absent.
Vector3 read_turn(ConfigReader& in, const std::string& key);

/// Mass of a body: given directly, or by a density.
struct BodyMass {
  std::optional<double> mass_kg = std::nullopt;
  double density_kg_m3 = 0.0;

  /// Returns the mass of a solid of this volume, kg.
  double mass_of(double volume_m3) const { return mass_kg ? *mass_kg : density_kg_m3 * volume_m3; }
  /// Returns the density of a solid of this volume, kg/m³.
  double density_of(double volume_m3) const { return mass_kg ? *mass_kg / volume_m3 : density_kg_m3; }
};
/// Reads `mass_g` or `density_kg_m3`.
BodyMass read_body_mass(ConfigReader& in);

}  // namespace tacipc
