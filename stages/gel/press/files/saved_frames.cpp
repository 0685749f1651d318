#include "stages/gel/press/files/saved_frames.h"

#include "common/base/checked_file.h"
#include "common/base/error.h"

namespace tacipc {
namespace {

/// Removes `text` from the beginning of `bytes`. \return false if they do not begin with it
bool skip(std::string& bytes, const std::string& text) {
  if (bytes.compare(0, text.size(), text) != 0) return false;
  bytes.erase(0, text.size());
  return true;
}

}  // namespace

void SolvedFrames::keep(const std::string& bytes) {
  write_checked_file(stage_.output("solved/" + name()), identity_ + motion_.at(next_) + bytes);
}

void SolvedFrames::save(const std::string& bytes) {
  keep(bytes);
  ScratchFrames::save(bytes);
}

std::optional<std::string> SolvedFrames::load() {
  if (const auto file = folder_ / name(); next_ < motion_.size() && std::filesystem::is_regular_file(file)) {
    auto bytes = read_checked_file(file);
    if (!bytes || !skip(*bytes, identity_))
      throw DataError("{}: is damaged, or of another gel, sensor, press file, body or contact", file.string());
    if (!skip(*bytes, motion_[next_]))
      throw DataError("{}: is of another motion than frame {} of the scene", file.string(), next_);
    ++next_;
    return bytes;
  }
  auto bytes = stage_.load_scratch(name());
  if (bytes) keep(*bytes), ++next_;
  return bytes;
}

}  // namespace tacipc
