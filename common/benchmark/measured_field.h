// Marker vectors that were measured in a photograph.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

namespace tacipc {

/// Column i is marker i, px: its rest place and how far it has moved since.
struct MarkerField {
  Eigen::Matrix2Xd rest_px;
  Eigen::Matrix2Xd moved_px;
};

/// Reads a table with the header Mx,My,dx,dy. \throw DataError `FILE:LINE: …` for a row one cannot read, or without
/// rows
MarkerField read_marker_field(const std::filesystem::path& path);

/// Median of each coordinate over the columns; of an even number the mean of the two in the middle. \pre not empty
Eigen::Vector2d median_of(const Eigen::Matrix2Xd& vectors);

/// The image's frame with, at each marker, a green dot where it rests, a red arrow to where it was measured and a
/// blue one to where it was simulated, both `enlarged` times as long; SVG text. \pre as many simulated vectors as
/// markers
std::string quiver_svg(const MarkerField& measured, const Eigen::Matrix2Xd& simulated_px,
                       const Eigen::Vector2d& image_px, double enlarged, const std::string& title);

}  // namespace tacipc
