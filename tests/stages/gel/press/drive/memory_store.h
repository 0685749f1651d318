// Frames of a run in memory, for tests that interrupt it.
#pragma once

#include <string>
#include <vector>

#include "stages/gel/press/drive/frame_run.h"

namespace tacipc {

/// Keeps frames; hands out the first ones that it is given.
class MemoryStore final : public FrameStore {
 public:
  explicit MemoryStore(std::vector<std::string> known = {}) : known_(std::move(known)) {}
  void save(const std::string& bytes) override { saved.push_back(bytes); }
  std::optional<std::string> load() override {
    if (saved.size() >= known_.size()) return std::nullopt;
    saved.push_back(known_[saved.size()]);
    return saved.back();
  }
  std::vector<std::string> saved;

 private:
  std::vector<std::string> known_;
};

}  // namespace tacipc
