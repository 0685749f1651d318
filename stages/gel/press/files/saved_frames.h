// Stores frames of an interrupted run in scratch files of a stage, and reuses frames of another run of a scene.
#pragma once

#include <fmt/core.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/stage/stage.h"
#include "stages/gel/press/drive/frame_run.h"

namespace tacipc {

/// Frames as scratch files of the stage.
class ScratchFrames : public FrameStore {
 public:
  explicit ScratchFrames(Stage& stage) : stage_(stage) {}
  void save(const std::string& bytes) override { stage_.save_scratch(name(), bytes), ++next_; }
  std::optional<std::string> load() override {
    auto bytes = stage_.load_scratch(name());
    if (bytes) ++next_;
    return bytes;
  }

 protected:
  std::string name() const { return fmt::format("frame_{:05d}", next_); }
  Stage& stage_;
  std::size_t next_ = 0;
};

/// Frames of a scene that is solved in pieces: the first frames come from a folder, and all others are written to
/// solved/ in the stage's outputs.
class SolvedFrames final : public ScratchFrames {
 public:
  /// \param identity text of everything that a frame depends on, except its motion
  /// \param motion_by_frame text of the motion of each frame, from frame 0 on
  SolvedFrames(Stage& stage, std::filesystem::path folder, std::string identity,
               std::vector<std::string> motion_by_frame)
      : ScratchFrames(stage),
        folder_(std::move(folder)),
        identity_(std::move(identity)),
        motion_(std::move(motion_by_frame)) {}
  void save(const std::string& bytes) override;
  std::optional<std::string> load() override;

 private:
  void keep(const std::string& bytes);
  std::filesystem::path folder_;
  std::string identity_;
  std::vector<std::string> motion_;
};

}  // namespace tacipc
