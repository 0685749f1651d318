// Markers as arrows over the contacts, as an SVG drawing.
#pragma once

#include <string>
#include <vector>

#include "stages/dataset/report/markers.h"

namespace tacipc {

/// What part of the front face is drawn, mm.
struct View {
  double low_x = 0.0, high_x = 1.0;
  double low_y = 0.0, high_y = 1.0;
};

/// The same for all pictures of a sample: every marker and contact of them and a margin. \pre something to see in one
View view_of(const std::vector<MarkerPicture>& pictures);

/// How many times longer than they are the arrows are drawn: 1, 2 or 5 times a power of ten, so that the longest
/// just does not reach the next marker. 1 if nothing moved.
double arrow_scale(const std::vector<MarkerArrow>& arrows);

/// Length of the longest arrow, mm.
double longest_mm(const std::vector<MarkerArrow>& arrows);

/// Dots at the markers, arrows from them, stuck and slipping contacts underneath, and an arrow of known length beside.
/// x to the right, y down, as in the tactile image.
std::string quiver_svg(const MarkerPicture& picture, const View& view);

}  // namespace tacipc
