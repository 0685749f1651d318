// Frames as bytes, so that an interrupted motion resumes after the last one.
#pragma once

#include <string>
#include <string_view>

#include "common/stage/stage.h"
#include "stages/gel/press/drive/grasp.h"
#include "stages/gel/press/drive/grip_control.h"
#include "stages/gel/press/drive/scene.h"
#include "stages/gel/press/drive/simulate.h"

namespace tacipc {

/// All bits of a frame and of what the next one starts from.
std::string pack_frame(const Frame& frame, const Progress& progress);

/// The inverse. \throw DataError if the bytes are not such a frame.
void unpack_frame(std::string_view bytes, Frame& frame, Progress& progress);

/// What a grasp goes on from.
struct GraspProgress {
  State state;
  Positions mount_n;                  // forces of the mounts on all gels' vertices
  std::array<GripControl, 2> drives;  // of left and right finger; one that moves both counts as two that are alike
  Matrix4 world_from_hand = Matrix4::Identity();
  double grip_n = 0.0;  // Grasp::grip_n
};

/// The same of a grasp: its frame, those of both fingers, and what the next ones start from.
std::string pack_frame(const GraspFrame& frame, const std::array<Frame, 2>& fingers, const GraspProgress& progress);
void unpack_frame(std::string_view bytes, GraspFrame& frame, std::array<Frame, 2>& fingers, GraspProgress& progress);

/// What a scene goes on from.
struct SceneProgress {
  State state;
  Positions mount_n;             // force of the mounts, a row per vertex of deformable bodies
  std::vector<int> held_bodies;  // in the last step
  std::vector<Wrench> others;    // of each body that is fixed or held on all others, about the world's origin
};

/// The same of a scene: its frame, those of its gels, and what the next ones start from.
std::string pack_frame(const SceneFrame& frame, const std::vector<Frame>& gels, const SceneProgress& progress);
void unpack_frame(std::string_view bytes, SceneFrame& frame, std::vector<Frame>& gels, SceneProgress& progress);

/// Frames in the scratch files of a stage.
class ScratchFrames final : public FrameStore {
 public:
  explicit ScratchFrames(Stage& stage) : stage_(stage) {}
  void save(const Frame& frame, const Progress& progress) override;
  bool load(Frame& frame, Progress& progress) override;

 private:
  Stage& stage_;
  int next_ = 0;
};

}  // namespace tacipc
