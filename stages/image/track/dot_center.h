// Finds the centre of a dark dot, to a fraction of a pixel.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/image/image.h"

namespace tacipc {

/// Centre and size of a dot.
struct DotCenter {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();  // column, row; the first pixel spans 0 … 1
  double area_px = 0.0;                          // Σ coverage
  double contrast = 0.0;                         // 1 − light in the middle over that around the dot
  double diameter_px() const;                    // Diameter of a disc of that area.
};

/// Window of the evaluation: dots lie within `inside_px` of their centre; the ring from there to `outside_px` shows the
/// surroundings.
struct DotWindow {
  double inside_px = 0.0;
  double outside_px = 0.0;

  /// Window for a dot of a diameter, limited to half the distance to the next dot.
  static DotWindow of(double diameter_px, double spacing_px);
};

/// Centroid of the dot's coverage of each pixel, Σ c p / Σ c over the window around the centre. It is repeated around
/// the result until that moves by less than 10⁻³ px. The coverage is c = (1 − L / B) / C, clamped to [0, 1], with a
/// ramp to 0 between 0.08 and 0.03, where it is noise. B is the plane fitted to the light L in the ring, without pixels
/// 10 % darker than the previous plane, which belong to neighbours; C is the contrast in the middle of the dot. An even
/// slope of light therefore does not shift a centre. If the centre still oscillates a little after 20 rounds, the
/// middle of the last two counts.
/// \return nothing if the dot leaves the image, the ring has fewer than 12 pixels, the contrast is below
/// `least_contrast`, or the centre still moves by more than 0.05 px after 20 rounds
std::optional<DotCenter> dot_center(const FloatImage& light, const Eigen::Vector2d& guess_px, const DotWindow& window,
                                    double least_contrast);

}  // namespace tacipc
