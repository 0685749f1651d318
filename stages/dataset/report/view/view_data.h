// Data of the 3-D view as one classic script, which a page opened from disk can load.
#pragma once

#include <string>
#include <vector>

#include "stages/dataset/report/view/scene_view.h"

namespace tacipc {

/// Grid that stores coordinates as integers: `low` + `step` · q with q in 0 … 65535, and an error of at most half a
/// step.
struct ViewGrid {
  Vector3 low_m = Vector3::Zero();
  double step_m = 1.0;
  Eigen::Vector3i size = Eigen::Vector3i::Zero();  // number of steps to the opposite corner

  /// Smallest grid around all sets.
  /// \pre no set is empty
  static ViewGrid around(const std::vector<const Positions*>& sets);
  int steps(double coordinate_m, int axis) const;
};

/// Integers as three planes of bytes, the lowest first. A value n ≥ 0 is stored as 2 n, a negative one as −2 n − 1.
/// Small values of both signs leave the upper planes zero, which deflate compresses well.
/// \throw DataError for a value that does not fit: |n| ≥ 2²³
std::string byte_planes(const std::vector<int>& values);

/// Script `tacipc_view({…});` with the keys
/// - `frames`: lists of the content of each frame's line; `texts`: one for each frame of the view
/// - `gels` and `objects`: name, numbers of vertices and triangles, grid, and `poses`, for each frame the pose in the
/// world, row by row; for gels also the `pictures` of each frame, if there are any; for objects that are not rigid and
/// free also a `kind`: soft, fixed or robot
/// - `indentation_m`: deepest indentation of all gels; `pressure_pa`: the pressure that is stored as 255, above which
/// lies 1 % of all nonzero pressures, so that the few peaks at edges do not take up the colours
/// - `colors`: the 256 colours of the bar
/// - `packed`: base64 of a zlib stream of byte planes, in this order: for each gel the triangles of its front, and for
/// each frame positions, pressures (0 to 255) and states (codes of contact_state.npy); for each object its triangles
/// and positions, for a soft one those of every frame. Triangles: first corners, each minus the previous one; second
/// minus first, third minus first. Positions, in the gel's or object's own frame: all x, all y, all z in steps of the
/// grid, each minus the previous vertex or, from the second frame on, minus the previous frame.
/// Equal views give equal bytes.
std::string view_script(const SceneView& view, const std::vector<std::string>& texts);

/// Rest height minus deformed height of the deepest vertex of all gels in a frame of the view, m.
double deepest_indentation(const SceneView& view, std::size_t frame);

}  // namespace tacipc
