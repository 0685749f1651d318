// Centre of a dark dot, to a fraction of a pixel.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/image/image.h"

namespace tacipc {

struct DotCenter {
  Eigen::Vector2d px = Eigen::Vector2d::Zero();  // column, row; the first pixel spans 0 … 1
  double area_px = 0.0;                          // Σ coverage
  double contrast = 0.0;                         // in the middle: 1 − light over that around the dot
  double diameter_px() const;                    // of the disc of that area
};

/// How wide to look: dots lie within `inside_px` of their centre, the ring from there to `outside_px` shows what
/// surrounds them.
struct DotWindow {
  double inside_px = 0.0;
  double outside_px = 0.0;

  /// For a dot of a diameter, no wider than half the distance to the next one.
  static DotWindow of(double diameter_px, double spacing_px);
};

/// Centroid of how much the dot covers of each pixel: Σ c p / Σ c over the window about the centre, repeated about what
/// came out until it moves by less than 10⁻³ px. c = (1 − L / B) / C, clamped to [0, 1] and led to 0 from 0.08 to 0.03,
/// where it is noise; B is the plane fitted to the light L in the ring (without what is 10 % darker than the plane
/// before: neighbours), C the contrast in the middle of the dot. So an even slope of light does not shift a centre.
/// Nothing where the dot leaves the image, the ring has fewer than 12 pixels, the contrast is below `least_contrast`,
/// or the centre still moves by more than 0.05 px after 20 rounds (if it swings by less, the middle of the last two).
std::optional<DotCenter> dot_center(const FloatImage& light, const Eigen::Vector2d& guess_px, const DotWindow& window,
                                    double least_contrast);

}  // namespace tacipc
