// Reads the deformed front face of a gel from a press folder.
#pragma once

#include <filesystem>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// Front face in every frame.
struct FrontFrames {
  Triangles triangles;                   // indices into the rows of a frame, oriented outward
  std::vector<Positions> frames;         // front vertices, m
  std::vector<Matrix4> gel_from_object;  // one per frame
};

/// Reads positions and poses of a finished press run and the front of its gel.
/// \throw DataError as PressFolder, or if the run belongs to another gel
FrontFrames read_front_frames(const std::filesystem::path& press, const std::filesystem::path& gel);

}  // namespace tacipc
