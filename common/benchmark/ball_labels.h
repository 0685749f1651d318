// Contacts seen in photographs of ball presses, and their labels made by hand.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tacipc {

/// Contact in one photograph of a ball: centre (column, row of a pixel, its middle) and radius.
struct BallLabel {
  std::string image;  // file name
  double x_px = 0.0;
  double y_px = 0.0;
  double radius_px = 0.0;
};

/// Lines `image.png (x, y) radius`; blank lines do not count. \throw DataError `FILE:LINE: …` for any other line, and
/// for a file without labels.
std::vector<BallLabel> read_labels(const std::filesystem::path& path);

}  // namespace tacipc
