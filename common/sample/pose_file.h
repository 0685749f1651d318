// Poses of rigid objects outside a press folder, as stages estimated or set them.
#pragma once

#include <filesystem>
#include <vector>

#include "common/base/types.h"
#include "common/format/npy_field.h"
#include "common/stage/stage.h"

namespace tacipc {

/// Returns the declaration of the poses that `shade` writes, one per image.
const NpyField& image_poses_field();
/// Returns the declaration of the poses that `calibrate` writes, one per ball.
const NpyField& ball_poses_field();

/// Writes poses as an output of a stage, under the field's name.
void write_poses(Stage& stage, const NpyField& field, const std::vector<Matrix4>& gel_from_object);

/// Reads one pose (4, 4) or several (n, 4, 4), from these files or a press folder's.
/// \throw DataError if there is no pose, or one is not a rigid motion
std::vector<Matrix4> read_poses(const std::filesystem::path& path);

}  // namespace tacipc
