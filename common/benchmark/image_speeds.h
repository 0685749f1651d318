// Processor times of tactile images by method: image_speeds.csv of bench_rivals, which `tabulate` shows next to errors.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tacipc {

/// Processor time of one frame of a method at one image size, on one thread, without file access.
struct ImageSpeed {
  std::string method;
  int width_px = 0;
  int height_px = 0;
  double simulation_ms = 0.0;  // time of the preceding simulation over its frames; 0: no simulation
  double object_ms = 0.0;      // time of the object's depth
  double membrane_ms = 0.0;
  double light_ms = 0.0;

  /// Returns the time of one image, without the simulation.
  double image_ms() const { return object_ms + membrane_ms + light_ms; }
  /// Returns the total, such as `146 + press 1627`, ms.
  std::string total() const;
  bool operator==(const ImageSpeed&) const = default;
};

/// Returns the table.
std::string to_csv(const std::vector<ImageSpeed>& speeds);
/// Reads the table.
/// \throw DataError if a column is missing or a field is not a number
std::vector<ImageSpeed> read_image_speeds(const std::filesystem::path& file);

}  // namespace tacipc
