// Writes a press or a grasp as one binary glTF 2.0 file, for Blender and viewers: fronts over time and moving objects.
#pragma once

#include <string>

#include "stages/gel/export/open_press.h"

namespace tacipc {

/// Bytes of a .glb file, little-endian, in metres and single precision. A root node rotates the world (frame S of a
/// press; z up here) to the y-up axes of glTF. Below it are:
/// - A node per gel, `gel` or `gel <name>`: the front face at rest in the gel's own frame S. Every later frame has a
///   morph target, the displacement of each vertex. Colours show the indentation in the last frame, on the same scale
///   for all gels, as in the report's pictures. There are no normals: viewers must compute their own, which are right
///   in every frame. If S moves in the world, the node has its pose.
/// - A node per soft body, `soft <name>`: its surface in frame 0, also with morph targets.
/// - A node per object, `object` or `object <name>`: the mesh in its own frame; the node has the pose.
/// One animation plays all nodes at the times of the frames, linearly between them. With one frame there is none. The
/// same scene gives the same bytes.
/// \throw DataError if the file would exceed 4 GiB
std::string glb_bytes(const OpenScene& scene);

}  // namespace tacipc
