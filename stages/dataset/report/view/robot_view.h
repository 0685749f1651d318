// A robot in the 3-D view and in pictures of it.
#pragma once

#include <filesystem>

#include "common/sample/robot_folder.h"
#include "common/sample/scene_folder.h"
#include "stages/dataset/report/view/scene_view.h"

namespace tacipc {

/// Adds the shapes of the robot's bodies, and of what stands around it; not of bodies that the scene has itself.
/// `folder`: of the robot. \throw DataError for a shape that cannot be read \pre the robot has the scene's frames
void add_robot(SceneView& view, const RobotFolder& robot, const std::filesystem::path& folder,
               const SceneFolder& scene);

}  // namespace tacipc
