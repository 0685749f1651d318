// The front face in the frames of a press, as `press` leaves it.
#pragma once

#include <filesystem>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

struct FrontFrames {
  Triangles triangles;                   // outward, over the rows of a frame
  std::vector<Positions> frames;         // front vertices, m
  std::vector<Matrix4> gel_from_object;  // per frame
};

/// Reads positions and poses of a finished press and the front of its gel. \throw DataError as PressFolder, and if the
/// press is of another gel.
FrontFrames read_front_frames(const std::filesystem::path& press, const std::filesystem::path& gel);

}  // namespace tacipc
