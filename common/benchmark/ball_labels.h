// Hand-made labels of contacts in photographs of ball presses.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tacipc {

/// Contact in one photograph of a ball: centre (column and row; a pixel's middle is a whole number) and radius.
struct BallLabel {
  std::string image;  // file name
  double x_px = 0.0;
  double y_px = 0.0;
  double radius_px = 0.0;
};

/// Reads lines `image.png (x, y) radius`; blank lines are ignored.
/// \throw DataError `FILE:LINE: …` for any other line, and for a file without labels
std::vector<BallLabel> read_labels(const std::filesystem::path& path);

}  // namespace tacipc
