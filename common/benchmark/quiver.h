// Measured and simulated marker vectors in one picture.
#pragma once

#include <Eigen/Core>
#include <string>

#include "common/benchmark/measured_field.h"

namespace tacipc {

/// The image's frame with, at each marker, a green dot where it rests, a red arrow to where it was measured and a
/// blue one to where it was simulated, both `enlarged` times as long; SVG text. \pre as many simulated vectors as
/// markers
std::string quiver_svg(const MarkerField& measured, const Eigen::Matrix2Xd& simulated_px,
                       const Eigen::Vector2d& image_px, double enlarged, const std::string& title);

}  // namespace tacipc
