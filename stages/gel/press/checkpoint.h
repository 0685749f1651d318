// Frames as bytes, so that an interrupted motion resumes after the last one.
#pragma once

#include <string>
#include <string_view>

#include "common/stage/stage.h"
#include "stages/gel/press/simulate.h"

namespace tacipc {

/// All bits of a frame and of what the next one starts from.
std::string pack_frame(const Frame& frame, const Progress& progress);

/// The inverse. \throw DataError if the bytes are not such a frame.
void unpack_frame(std::string_view bytes, Frame& frame, Progress& progress);

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
