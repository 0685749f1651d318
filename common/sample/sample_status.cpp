#include "common/sample/sample_status.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <string>

namespace tacipc {
namespace fs = std::filesystem;
namespace {

/// Whether somebody holds the lock that a sample's make takes.
bool is_locked(const fs::path& lock) {
  const int file = ::open(lock.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool held = ::flock(file, LOCK_SH | LOCK_NB) != 0;
  ::close(file);
  return held;
}

}  // namespace

const char* status_word(SampleStatus status) {
  switch (status) {
    case SampleStatus::made:
      return "made";
    case SampleStatus::failed:
      return "failed";
    case SampleStatus::running:
      return "running";
    case SampleStatus::unmade:
      return "not made";
  }
  return "";
}

SampleStatus status_of(const fs::path& folder) {
  if (!fs::exists(folder / "press")) return SampleStatus::unmade;
  if (fs::exists(folder / "press/press.yaml") && fs::exists(folder / "render/render.yaml")) return SampleStatus::made;
  for (const char* stage : {"press", "render"})
    if (is_locked(folder / stage / ".making")) return SampleStatus::running;
  for (const std::string stage : {"press", "render"})
    if (fs::exists(folder / stage / (stage + ".failed.yaml"))) return SampleStatus::failed;
  return SampleStatus::unmade;
}

bool was_dropped(const fs::path& stage_folder) { return fs::exists(stage_folder / ".dropped"); }

}  // namespace tacipc
