// The YAML file of an object: unit of its mesh, scale, side that faces away from the gel, and repairs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// Conversion of an object to a height field: the solid below the surface that one side of the mesh shows.
struct SideConfig {
  static constexpr const char* kMostRelief = "most_relief";
  std::string side = "-z";  // side that presses: +x -x +y -y +z -z of the mesh, or kMostRelief
  double spacing_m = 5e-5;  // grid spacing
};

/// Settings of the stage `wrap`, which makes a closed surface around any other.
struct WrapConfig {
  // Range of alpha over the box's diagonal. Time and memory grow as (diagonal / alpha)²: the smallest value takes
  // minutes and gigabytes; the largest leaves no shape.
  static constexpr double kFinest = 5e-4, kCoarsest = 0.5;
  double relative_alpha = 0.004;                  // alpha over the diagonal of the object's box
  std::optional<double> alpha_m = std::nullopt;   // replaces it: radius of the smallest openings that stay open
  std::optional<double> offset_m = std::nullopt;  // distance kept from the surface; absent: a fraction of alpha
};

/// Contents of configs/objects/*.yaml.
struct ObjectSpec {
  static constexpr const char* kAutoUnit = "auto";  // unit stated by the file, else by its name, else mm

  std::string unit;               // unit of the mesh file: m, cm, mm, um, in or auto
  std::optional<std::string> up;  // side of the mesh that faces away from the gel: +x -x +y -y +z -z
  double scale = 1.0;             // scale factor of the mesh, after its unit
  bool fit_window = false;        // `scale: fit`: fit the object to the sensor's field of view
  std::optional<double> sheet_thickness_m = std::nullopt;  // thickness of plates made from open surfaces
  std::optional<WrapConfig> wrap = std::nullopt;           // applied before `decimate`, by the stage `wrap`
  std::optional<SideConfig> height_field = std::nullopt;   // settings for meshes that no repair closes

  /// Reads the file.
  static ObjectSpec read(ConfigReader& in);
  /// Returns the text of a file that read() accepts, without keys at their defaults.
  std::string yaml() const;
};

}  // namespace tacipc
