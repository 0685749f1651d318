#include "stages/dataset/survey/plan_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "common/base/error.h"

namespace tacipc {
namespace fs = std::filesystem;

bool wait_for_plan(const fs::path& dataset) {
  const int lock = ::open((dataset / "plan/.lock-plan").c_str(), O_RDONLY | O_CLOEXEC);
  if (lock < 0) return true;
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(10);
  bool free = false;
  while (!(free = ::flock(lock, LOCK_SH | LOCK_NB) == 0) && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ::close(lock);
  return free;
}

fs::path samples_table(const fs::path& dataset) {
  fs::path table = dataset / "plan/samples.csv";
  if (!fs::exists(table)) wait_for_plan(dataset);
  if (!fs::exists(table)) throw DataError("there is no {} yet: make -f Makefile.data plan CONFIG=...", table.string());
  return table;
}

std::string name_of_dataset(const fs::path& dataset) {
  return (dataset.has_filename() ? dataset : dataset.parent_path()).filename().string();
}

}  // namespace tacipc
