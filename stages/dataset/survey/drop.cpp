#include "stages/dataset/survey/drop.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <set>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/sha256.h"
#include "common/format/csv.h"
#include "common/sample/dataset_plan.h"
#include "common/sample/ensemble.h"
#include "common/sample/sample_status.h"
#include "common/stage/record.h"
#include "stages/dataset/survey/plan_lock.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

/// Lock of a stage of a sample, if it is free.
class MakingLock {
 public:
  explicit MakingLock(const fs::path& stage_folder)
      : file_(::open((stage_folder / ".making").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666)),
        held_(file_ >= 0 && ::flock(file_, LOCK_EX | LOCK_NB) == 0) {}
  ~MakingLock() {
    if (file_ >= 0) ::close(file_);
  }
  MakingLock(const MakingLock&) = delete;
  MakingLock& operator=(const MakingLock&) = delete;
  bool held() const { return held_; }

 private:
  int file_;
  bool held_;
};

struct Packed {
  std::string press_sha256, render_sha256;
};

/// Packed samples by id, including those of `open_shards`, in which a sample is not made.
std::map<std::string, Packed> packed_samples(const fs::path& manifest, std::set<std::string>& open_shards) {
  if (!fs::exists(manifest))
    throw DataError("{} is not packed; nothing is removed", manifest.parent_path().parent_path().string());
  CsvReader rows(manifest);
  for (const std::string column : {"press_sha256", "render_sha256"})
    if (std::ranges::find(rows.columns(), column) == rows.columns().end())
      throw DataError("{} has no {}; pack it again; nothing is removed", manifest.string(), column);
  std::map<std::string, Packed> packed;
  while (rows.next()) {
    if (rows["status"] == "made")
      packed[rows["id"]] = {rows["press_sha256"], rows["render_sha256"]};
    else
      open_shards.insert(rows["shard"]);
  }
  return packed;
}

void remove_outputs(const fs::path& folder, const std::string& stage) {
  // The mark is written first, so that the remaining files never pass for a complete sample.
  write_file(folder / ".dropped", "");
  std::set<fs::path> folders;
  for (const std::string& name : Record::from_file(folder / (stage + ".yaml")).section("outputs").keys()) {
    fs::remove(folder / name);
    for (fs::path above = fs::path(name).parent_path(); !above.empty(); above = above.parent_path())
      folders.insert(above);
  }
  std::error_code not_empty;
  for (auto below = folders.rbegin(); below != folders.rend(); ++below) fs::remove(folder / *below, not_empty);
}

/// Removes the presses of ensemble members for a sample, except one that is being made.
void drop_members(const fs::path& sample_folder) {
  const fs::path all = member_presses(sample_folder);
  if (!fs::is_directory(all)) return;
  for (const auto& member : fs::directory_iterator(all)) {
    const fs::path press = member_press(sample_folder, member.path().filename().string());
    if (!fs::exists(press / "press.yaml") || was_dropped(press)) continue;
    const MakingLock lock(press);
    if (lock.held()) remove_outputs(press, "press");
  }
}

}  // namespace

Dropped drop_packed(const fs::path& dataset, const std::vector<std::string>& stages, bool whole_shards) {
  Dropped dropped;
  std::set<std::string> open_shards;
  const auto packed = packed_samples(dataset / "pack/manifest.csv", open_shards);
  for_each_planned(samples_table(dataset), std::nullopt, [&](const PlannedRow& row) {
    const auto found = packed.find(row.id);
    if (found == packed.end() || (whole_shards && open_shards.contains(row.shard))) return;
    const fs::path folder = dataset / row.folder;
    const fs::path press = folder / "press/press.yaml", render = folder / "render/render.yaml";
    const auto is_open = [&](const std::string& stage) { return !was_dropped(folder / stage); };
    if (std::ranges::none_of(stages, is_open) || !fs::exists(press) || !fs::exists(render)) return;
    const MakingLock press_lock(stage_folder(folder, "press")), render_lock(folder / "render");
    if (!press_lock.held() || !render_lock.held() || !fs::exists(press) || !fs::exists(render) ||
        sha256_of_file(press) != found->second.press_sha256 || sha256_of_file(render) != found->second.render_sha256) {
      ++dropped.samples;
      return;
    }
    for (const std::string& stage : stages) {
      if (!is_open(stage)) continue;
      if (stage == "press") drop_members(folder);
      remove_outputs(folder / stage, stage);
      ++dropped.stages;
    }
  });
  return dropped;
}

}  // namespace tacipc
