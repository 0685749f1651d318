// What a tactile image costs by each method: image_speeds.csv of bench_rivals, which tabulate shows beside errors.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tacipc {

/// Processor time of one frame of a method in images of one size, on one thread, files not counted.
struct ImageSpeed {
  std::string method;
  int width_px = 0;
  int height_px = 0;
  double simulation_ms = 0.0;  // the simulation before it, divided by its frames; 0: none
  double object_ms = 0.0;      // the object's depth
  double membrane_ms = 0.0;
  double light_ms = 0.0;

  double image_ms() const { return object_ms + membrane_ms + light_ms; }
  /// `146 + press 1627`, ms
  std::string total() const;
  bool operator==(const ImageSpeed&) const = default;
};

std::string to_csv(const std::vector<ImageSpeed>& speeds);
/// \throw DataError if a column is missing or a number is none
std::vector<ImageSpeed> read_image_speeds(const std::filesystem::path& file);

}  // namespace tacipc
