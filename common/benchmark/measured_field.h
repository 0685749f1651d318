// Marker displacements measured in a photograph.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

namespace tacipc {

/// Displacement field, px; column i is marker i.
struct MarkerField {
  Eigen::Matrix2Xd rest_px;
  Eigen::Matrix2Xd moved_px;
};

/// Reads a table with the header Mx,My,dx,dy.
/// \throw DataError if it has no rows, or `FILE:LINE: …` for a row that cannot be read
MarkerField read_marker_field(const std::filesystem::path& path);

/// Returns the median of each coordinate over the columns; for an even number, the mean of the middle two.
/// \pre not empty
Eigen::Vector2d median_of(const Eigen::Matrix2Xd& vectors);

/// Draws the field as SVG text: at each marker a green dot at its rest position, a red arrow for the measured and a
/// blue one for the simulated displacement, both `enlarged` times as long.
/// \pre as many simulated displacements as markers
std::string quiver_svg(const MarkerField& measured, const Eigen::Matrix2Xd& simulated_px,
                       const Eigen::Vector2d& image_px, double enlarged, const std::string& title);

}  // namespace tacipc
