// Draws markers as arrows over the contacts, as SVG.
#pragma once

#include <string>
#include <vector>

#include "stages/dataset/report/markers.h"

namespace tacipc {

/// Drawn part of the front face, mm.
struct View {
  double low_x = 0.0, high_x = 1.0;
  double low_y = 0.0, high_y = 1.0;
};

/// Common view of all pictures of a sample: all their markers and contacts, and a margin.
/// \pre some picture shows something
View view_of(const std::vector<MarkerPicture>& pictures);

/// Factor by which arrows are enlarged: 1, 2 or 5 times a power of ten, so that the longest arrow just does not reach
/// the next marker. 1 if nothing moved.
double arrow_scale(const std::vector<MarkerArrow>& arrows);

/// Length of the longest arrow, mm.
double longest_mm(const std::vector<MarkerArrow>& arrows);

/// Drawing with dots at the markers, arrows from them, stuck and slipping contacts below them, and an arrow of known
/// length. x points to the right and y down, as in the tactile image.
std::string quiver_svg(const MarkerPicture& picture, const View& view);

}  // namespace tacipc
