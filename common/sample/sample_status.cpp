#include "common/sample/sample_status.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace tacipc {
namespace fs = std::filesystem;
namespace {

/// Returns whether another process holds the lock of a sample's make.
bool is_locked(const fs::path& lock) {
  const int file = ::open(lock.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool held = ::flock(file, LOCK_SH | LOCK_NB) != 0;
  ::close(file);
  return held;
}

}  // namespace

const char* status_word(SampleStatus status) {
  constexpr const char* kWords[] = {"made", "failed", "running", "not made"};
  return kWords[static_cast<int>(status)];
}

bool is_finger(const fs::path& sample_folder) {
  if (sample_folder.filename() != "left" && sample_folder.filename() != "right") return false;
  // A planned sample of that name has these files itself.
  return !fs::exists(sample_folder / "sample.yaml") && !fs::exists(sample_folder / "press/press.log");
}

fs::path stage_folder(const fs::path& sample_folder, const std::string& stage) {
  return stage == "press" && is_finger(sample_folder) ? sample_folder.parent_path() : sample_folder / stage;
}

fs::path stage_file(const fs::path& sample_folder, const std::string& stage, const std::string& ending) {
  return stage_folder(sample_folder, stage) / (stage + ending);
}

std::optional<fs::path> timings_file(const fs::path& sample_folder, const std::string& stage) {
  if (stage == "press" && is_finger(sample_folder) && sample_folder.filename() == "right") return std::nullopt;
  fs::path file = stage_file(sample_folder, stage, ".timings.yaml");
  if (!fs::exists(file)) return std::nullopt;
  return file;
}

SampleStatus status_of(const fs::path& folder) {
  if (!fs::exists(stage_folder(folder, "press"))) return SampleStatus::unmade;
  if (fs::exists(folder / "press/press.yaml") && fs::exists(folder / "render/render.yaml")) return SampleStatus::made;
  for (const std::string stage : {"press", "render"})
    if (is_locked(stage_folder(folder, stage) / ".making")) return SampleStatus::running;
  for (const std::string stage : {"press", "render"})
    if (fs::exists(stage_file(folder, stage, ".failed.yaml"))) return SampleStatus::failed;
  return SampleStatus::unmade;
}

bool was_dropped(const fs::path& stage_folder) { return fs::exists(stage_folder / ".dropped"); }

}  // namespace tacipc
