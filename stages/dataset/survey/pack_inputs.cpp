#include "stages/dataset/survey/pack_inputs.h"

#include <fmt/core.h>
#include <sys/stat.h>

#include <map>
#include <string>

#include "common/base/checked_file.h"
#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/sha256.h"
#include "common/config/config_text.h"
#include "common/sample/dataset_plan.h"
#include "common/sample/ensemble.h"
#include "common/sample/sample_status.h"
#include "common/stage/record.h"
#include "stages/dataset/survey/plan_lock.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

/// Time of a file's last change, to the nanosecond; empty if there is no file.
std::string time_text(const fs::path& file) {
  struct stat found {};
  if (::stat(file.c_str(), &found) != 0) return "";
  return fmt::format("{}.{:09}0", found.st_mtim.tv_sec, found.st_mtim.tv_nsec);
}

std::string shared_configuration(const fs::path& dataset_yaml) {
  ConfigText text(read_file(dataset_yaml), dataset_yaml.string());
  const Record record = Record::from_file(dataset_yaml);
  for (const char* key : {"outputs", "stop_after_failures"})
    if (record.has(key)) text.remove(key);
  return text.text();
}

bool holds(const fs::path& file, const std::string& text) {
  std::error_code error;
  return fs::is_regular_file(file, error) && read_file(file) == text;
}

}  // namespace

void write_pack_inputs(const fs::path& dataset, const fs::path& profile) {
  const fs::path table = dataset / "plan/samples.csv", configuration = dataset / "plan/dataset.yaml";
  if (fs::exists(dataset / "plan/.lock-plan")) {
    if (!wait_for_plan(dataset))
      throw DataError("the plan of {} has been in the making for ten minutes", dataset.string());
    if (!fs::exists(dataset / "plan/plan.yaml"))
      throw DataError("the plan of {} is half replaced; make it again: make -f Makefile.data plan CONFIG=...",
                      dataset.string());
  }
  for (const fs::path& file : {table, configuration, profile})
    if (!fs::exists(file)) throw UsageError(fmt::format("there is no {}", file.string()));

  const std::string shared = shared_configuration(configuration);
  std::string common = sha256(shared) + sha256_of_file(profile);
  std::vector<std::string> presses;  // presses for each sample
  if (const auto ensemble = ensemble_of_dataset(dataset)) {
    common += sha256_of_file(dataset / kEnsembleFile);
    presses = ensemble->presses();
  }
  common += "\n";
  std::map<std::string, std::string> inputs;  // inputs of each shard
  std::string names, records;
  for_each_planned(table, std::nullopt, [&](const PlannedRow& row) {
    std::string& text = inputs[row.shard];
    if (text.empty()) {
      names.append(" ").append(row.shard);
      records += row.shard + "/pack.yaml\n";
      text = common;
    }
    std::string line = plan_line(row);
    line.pop_back();
    const fs::path folder = dataset / row.folder;
    for (const std::string stage : {"press", "render"})
      for (const fs::path& record : {folder / stage / (stage + ".yaml"), stage_file(folder, stage, ".failed.yaml")})
        line.append(" ").append(time_text(record));
    for (const std::string& press : presses)
      for (const char* record : {"press.yaml", "press.failed.yaml"})
        line.append(" ").append(time_text(member_press(folder, press) / record));
    text += line + "\n";
  });
  if (inputs.empty()) throw DataError("{} has no samples", table.string());

  const fs::path shards = dataset / "shards";
  replace_if_changed(shards / "dataset.yaml", shared);
  replace_if_changed(shards / "shards.txt", records);
  for (const auto& [shard, text] : inputs) {
    const fs::path file = shards / (shard + ".inputs");
    if (!replace_if_changed(file, text)) continue;
    // A shard whose repacking failed still corresponds to its earlier inputs. If these have come back, it is not packed
    // again.
    const fs::path record = shards / shard / "pack.yaml", packed_from = shards / shard / "packed.inputs";
    if (fs::exists(record) && holds(packed_from, text) &&
        fs::last_write_time(record) <= fs::last_write_time(packed_from))
      fs::last_write_time(file, fs::last_write_time(record));
  }
  replace_if_changed(shards / "shards.mk", "PACK_SHARDS :=" + names + "\n");
}

}  // namespace tacipc
