// Marker vectors that were measured in a photograph.
#pragma once

#include <Eigen/Core>
#include <filesystem>

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

}  // namespace tacipc
