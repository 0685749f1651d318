// Poses of rigid objects outside a press folder: where a stage found or put them.
#pragma once

#include <filesystem>
#include <vector>

#include "common/base/types.h"
#include "common/format/npy_field.h"
#include "common/stage/stage.h"

namespace tacipc {

/// Of shade: per image.
const NpyField& image_poses_field();
/// Of calibrate: per ball.
const NpyField& ball_poses_field();

/// As an output of a stage, under the field's name.
void write_poses(Stage& stage, const NpyField& field, const std::vector<Matrix4>& gel_from_object);

/// One pose (4, 4) or several (n, 4, 4), of these files or of a press folder. \throw DataError if there is none, or one
/// is not a rigid motion
std::vector<Matrix4> read_poses(const std::filesystem::path& path);

}  // namespace tacipc
