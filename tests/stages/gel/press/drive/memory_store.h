// Frames of a motion in memory, for tests that interrupt it.
#pragma once

#include <string>
#include <vector>

#include "stages/gel/press/drive/checkpoint.h"

namespace tacipc {

/// Keeps packed frames; hands out the first `known` of them.
class MemoryStore final : public FrameStore {
 public:
  explicit MemoryStore(std::vector<std::string> known = {}) : known_(std::move(known)) {}
  void save(const Frame& frame, const Progress& progress) override { saved.push_back(pack_frame(frame, progress)); }
  bool load(Frame& frame, Progress& progress) override {
    if (saved.size() >= known_.size()) return false;
    unpack_frame(known_[saved.size()], frame, progress);
    saved.push_back(known_[saved.size()]);
    return true;
  }
  std::vector<std::string> saved;

 private:
  std::vector<std::string> known_;
};

}  // namespace tacipc
