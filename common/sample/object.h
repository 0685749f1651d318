// An object as one file: the unit of its mesh, its scale, which side is up, and how it is mended.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// What one side of a mesh shows, as a solid.
struct SideConfig {
  static constexpr const char* kMostRelief = "most_relief";
  std::string side = "-z";  // that presses: +x -x +y -y +z -z of the mesh, or kMostRelief
  double spacing_m = 5e-5;  // of the grid
};

/// How the stage `wrap` makes a closed surface around any other.
struct WrapConfig {
  // Alpha over the box's diagonal. Time and memory grow as (diagonal / alpha)²: the finest takes minutes and gigabytes.
  // The coarsest leaves no shape.
  static constexpr double kFinest = 5e-4, kCoarsest = 0.5;
  double relative_alpha = 0.004;                  // of the box's diagonal: alpha, unless there is
  std::optional<double> alpha_m = std::nullopt;   // radius of the ball that fits into what stays open
  std::optional<double> offset_m = std::nullopt;  // distance kept from the surface; else a fraction of alpha
};

/// configs/objects/*.yaml
struct ObjectSpec {
  static constexpr const char* kAutoUnit = "auto";  // what the file, else its name, else millimetres say

  std::string unit;               // of the mesh file: m, cm, mm, um, in or auto
  std::optional<std::string> up;  // side of the mesh that looks away from the gel: +x -x +y -y +z -z
  double scale = 1.0;             // of the mesh, after its unit
  bool fit_window = false;        // `scale: fit`: to the sensor's window
  std::optional<double> sheet_thickness_m = std::nullopt;  // of plates made of what is open
  std::optional<WrapConfig> wrap = std::nullopt;           // before decimate, by the stage wrap
  std::optional<SideConfig> height_field = std::nullopt;   // of what no repair closes

  static ObjectSpec read(ConfigReader& in);
  /// As a file that `read` takes; without keys that have their defaults.
  std::string yaml() const;
};

}  // namespace tacipc
