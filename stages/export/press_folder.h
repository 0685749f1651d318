// The arrays of a finished press, checked against each other and against its gel.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "common/npy.h"
#include "common/tet_mesh.h"

namespace tacipc {

/// What export needs of a press; shapes in docs/files.md.
struct PressArrays {
  std::size_t frames = 0;
  std::vector<double> time_s;
  NpyArray positions;      // (frames, #V, 3)
  NpyArray object_pose;    // (frames, 4, 4)
  NpyArray contact_force;  // (frames, #V_front, 2, 3)
  NpyArray contact_state;  // (frames, #V_front)
  std::vector<int> front_vertices;

  Positions positions_of(std::size_t frame) const;
  Matrix4 pose_of(std::size_t frame) const;
};

/// \throw DataError if the press did not finish, was of another gel or object (by content hash), or an array has
/// another shape than the gel and the first axis of positions.npy ask for.
PressArrays read_press(const std::filesystem::path& folder, const std::filesystem::path& gel_path, const TetMesh& gel,
                       const std::filesystem::path& object_path);

}  // namespace tacipc
