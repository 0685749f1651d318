// Which side of an object has something to feel: relief in a sensor's window, side by side.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Who looks at an object, and which side it is pressed with if none is better.
struct SensorWindow {
  std::array<double, 2> size_m{};
  std::string usual = "-z";
};

/// What one side shows, along the axes of S once it presses (unturned).
struct SideView {
  std::string side;
  double relief_m = 0.0;             // of the best window
  double centered_relief_m = 0.0;    // of the window in the middle of the bounding box
  std::array<double, 2> place_m{};   // the best window's middle, from that of the bounding box
  double shown_m2 = 0.0;             // area of the object as seen
  double rim_touching = 0.0;         // share of its outline that touches first: 1 for a base, 0 for a tip on one
  std::array<double, 2> extent_m{};  // of the bounding box
  FloatImage height = {};            // m above what lies kPressDepth below the highest point; NaN: nothing there
};

struct SideSurvey {
  static constexpr double kPressDepth = 0.5e-3;
  std::array<double, 2> window_m{};
  std::vector<SideView> views;  // in the order of face_names()
  std::size_t pressed = 0;
  bool given = false;  // the side was asked for

  const SideView& side() const { return views[pressed]; }
  /// The object goes beyond the window, on both sides of an axis or one.
  bool wider_than_window() const;
  /// Nothing but a flat face fills the window.
  bool uniform() const;
};

/// Looks at all six sides. Relief of a window is the length of steps as high as a press is deep that would be as much,
///   R = (1/d) ∫ |∇ max(0, z − z_max + d)| dA,  d = kPressDepth,
/// outlines against nothing left out: 0 on a flat face, a circle's length on a stamped disc. The place is where R is
/// greatest, but the middle unless that is a tenth better. `pressed` is `wanted` if it names a side, else that of most
/// relief, but the usual one unless that is a quarter better or shows twenty times its area. Sides that something
/// stands out of (over 1 mm of relief, an outline that does not touch, a fifth of the greatest area) come before
/// others.
SideSurvey survey_sides(const TriangleMesh& mesh, const SensorWindow& window, const std::string& wanted);

/// Six pictures side by side in two rows, the pressed side's framed, its window drawn: ±x above, y, z beside them.
ByteImage picture_of_sides(const SideSurvey& survey);

}  // namespace tacipc
