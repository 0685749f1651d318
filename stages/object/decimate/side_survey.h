// Surveys the six sides of an object: relief within a sensor's field of view ("window").
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Field of view of the sensor, and the side that presses if no other is better.
struct SensorWindow {
  std::array<double, 2> size_m{};
  std::string usual = "-z";
};

/// One side, along the axes of S once it presses (unturned).
struct SideView {
  std::string side;
  double relief_m = 0.0;             // relief of the best window
  double centered_relief_m = 0.0;    // relief of the window at the centre of the bounding box
  std::array<double, 2> place_m{};   // centre of the best window, from the centre of the bounding box
  double shown_m2 = 0.0;             // visible area of the object
  double rim_touching = 0.0;         // fraction of the outline that touches first: 1 for a base, 0 for a tip on a base
  std::array<double, 2> extent_m{};  // extent of the bounding box
  FloatImage height =
      {};  // height above the plane kPressDepth below the highest point, m; NaN where there is no object
};

/// Views of all sides, and the side that presses.
struct SideSurvey {
  static constexpr double kPressDepth = 0.5e-3;
  std::array<double, 2> window_m{};
  std::vector<SideView> views;  // views in the order of face_names()
  std::size_t pressed = 0;
  bool given = false;  // the side was requested

  const SideView& side() const { return views[pressed]; }
  /// True if the object extends beyond the window along an axis, at one end or both.
  bool wider_than_window() const;
  /// True if a flat face fills the window.
  bool uniform() const;
};

/// Surveys all six sides. The relief of a window is a length,
///   R = (1/d) ∫ |∇ max(0, z − z_max + d)| dA,  d = kPressDepth,
/// without the object's outer outline. A step of height d contributes its length: a flat face gives 0, a stamped disc
/// its circumference. The best window is the one of largest R, but the central one unless the best is a tenth better.
/// `pressed` is `wanted` if that names a side; otherwise the side of most relief, but the usual side unless the other
/// is a quarter better or shows twenty times its area. Sides with a protrusion (over 1 mm of relief, an outline that
/// does not touch, a fifth of the largest area) precede others.
SideSurvey survey_sides(const TriangleMesh& mesh, const SensorWindow& window, const std::string& wanted);

/// Picture of six views in two rows: ±x above, then y and z; the pressed side has a frame and its window.
ByteImage picture_of_sides(const SideSurvey& survey);

}  // namespace tacipc
