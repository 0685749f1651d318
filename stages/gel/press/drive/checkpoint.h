// Serialised frames, so that an interrupted run resumes after the last one.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "stages/gel/press/drive/grasp_frame.h"
#include "stages/gel/press/drive/grip_control.h"
#include "stages/gel/press/drive/scene_frame.h"
#include "stages/gel/press/world/world.h"

namespace tacipc {

/// State from which a press resumes.
struct PressProgress {
  WorldState world;
  /// Displacement of the object along its free axes since the start of the phase, or on a compliant mount its
  /// deflection.
  Vector3 object_shift_m = Vector3::Zero();
};

/// State from which a grasp resumes.
struct GraspProgress {
  WorldState world;
  HandState hand;
};

/// Serialises a frame and the state that the next one starts from, bit by bit. unpack_frame() is the inverse.
/// \throw DataError if the bytes are not such a frame
std::string pack_frame(const Frame& frame, const PressProgress& progress);
void unpack_frame(std::string_view bytes, Frame& frame, PressProgress& progress);

/// Overloads for a grasp: its frame, and the frames of both fingers.
std::string pack_frame(const GraspFrame& frame, const std::vector<Frame>& fingers, const GraspProgress& progress);
void unpack_frame(std::string_view bytes, GraspFrame& frame, std::vector<Frame>& fingers, GraspProgress& progress);

/// Overloads for a scene: its frame, and the frames of its gels.
std::string pack_frame(const SceneFrame& frame, const std::vector<Frame>& gels, const WorldState& state);
void unpack_frame(std::string_view bytes, SceneFrame& frame, std::vector<Frame>& gels, WorldState& state);

}  // namespace tacipc
