// A press or a grasp as one binary glTF 2.0 file, for Blender and viewers: fronts over time and objects that move.
#pragma once

#include <string>

#include "stages/gel/export/open_press.h"

namespace tacipc {

/// The bytes of a .glb file, little-endian. A root node turns the world (frame S of a press; z up here) to the y-up
/// axes of glTF; below it, in metres and in single precision,
/// - a node per gel, `gel` or `gel <name>`: the front face at rest in the gel's own frame S, with a morph target for
///   every later frame (how far each vertex has moved), colours of the indentation in the last frame as in the report's
///   pictures, the same for all gels, and no normals: viewers must make their own, which are right in every frame;
///   where S moves in the world, the node has its pose;
/// - a node per soft body, `soft <name>`: its surface as it is in frame 0, morphed likewise;
/// - a node per object, `object` or `object <name>`: the mesh in its own frame; the node has the pose.
/// One animation plays all at the times of the frames, linearly between them. With one frame there is none.
/// Same scene, same bytes. \throw DataError if the file would exceed 4 GiB
std::string glb_bytes(const OpenScene& scene);

}  // namespace tacipc
