// The data of the 3-D view as one classic script, which a page opened from disk can load.
#pragma once

#include <string>
#include <vector>

#include "stages/dataset/report/view/scene_view.h"

namespace tacipc {

/// Coordinates as whole steps from a corner: `low` + `step` · q with q in 0 … 65535; an error of half a step at most.
struct ViewGrid {
  Vector3 low_m = Vector3::Zero();
  double step_m = 1.0;
  Eigen::Vector3i size = Eigen::Vector3i::Zero();  // steps to the opposite corner

  /// \pre none of the sets is empty
  static ViewGrid around(const std::vector<const Positions*>& sets);
  int steps(double coordinate_m, int axis) const;
};

/// Integers as three planes of bytes, the lowest first, each value n as 2 n where it is ≥ 0 and −2 n − 1 where it is
/// negative: small values of both signs leave the upper planes zero, which deflate makes vanish.
/// \throw DataError for a value that does not fit: |n| ≥ 2²³
std::string byte_planes(const std::vector<int>& values);

/// `tacipc_view({…});`, where
/// - `frames` are lists of what a frame's line says, `texts` one for each frame of the view
/// - `gels` and `objects` have their name, numbers of vertices and triangles, grid, and `poses`, for each frame the one
///   that takes them to the world, row by row; gels also the `pictures` of each frame, if there are any; objects that
///   are not rigid and free a `kind`: soft, fixed or robot
/// - `indentation_m` is the deepest indentation of all gels; `pressure_pa` the pressure that 255 stands for: 99 % of
///   all pressures that are not zero are below, so that the few peaks at edges do not take the colours
/// - `colors` are the 256 colours of the bar
/// - `packed` is base64 of a zlib stream of byte planes, in this order: for each gel triangles of its front and for
///   each frame positions, pressures (0 to 255), states (codes of contact_state.npy); for each object its triangles and
///   positions, of a soft one those of every frame. Triangles: first corners, each less the one before it; second less
///   first, third less first. Positions, in the gel's or object's own frame: all x, all y, all z in steps of the grid,
///   each less the vertex before it or, from the second frame on, less the frame before.
/// Same view, same bytes.
std::string view_script(const SceneView& view, const std::vector<std::string>& texts);

/// Rest minus deformed height of the deepest vertex of all gels in a frame of the view, m.
double deepest_indentation(const SceneView& view, std::size_t frame);

}  // namespace tacipc
