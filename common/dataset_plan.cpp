#include "common/dataset_plan.h"

#include "common/csv.h"
#include "common/error.h"

namespace tacipc {
namespace fs = std::filesystem;

void for_each_planned(const fs::path& samples_csv, const std::optional<std::string>& shard,
                      const std::function<void(const PlannedRow&)>& use) {
  CsvReader rows(samples_csv);
  bool found = false;
  while (rows.next()) {
    if (shard && rows["shard"] != *shard) continue;
    found = true;
    const PlannedRow sample{.id = rows["id"],
                            .index = rows["index"],
                            .split = rows["split"],
                            .split_pose = rows["split_pose"],
                            .seed = rows["seed"],
                            .sensor = rows["sensor"],
                            .mesh = rows["mesh"],
                            .object = rows["object"],
                            .motion = rows["motion"],
                            .shard = rows["shard"],
                            .folder = rows["folder"]};
    if (sample.id.empty() || sample.id.find('/') != std::string::npos || sample.id.front() == '.')
      throw DataError("{}:{}: '{}' is no sample's id", samples_csv.string(), rows.line(), sample.id);
    use(sample);
  }
  if (shard && !found) throw DataError("{}: has no shard '{}'", samples_csv.string(), *shard);
}

std::optional<Failure> failure_of(const fs::path& sample_folder) {
  for (const std::string stage : {"press", "render"}) {
    const fs::path folder = sample_folder / stage;
    if (fs::exists(folder / (stage + ".yaml"))) continue;
    const fs::path failed = folder / (stage + ".failed.yaml");
    if (!fs::exists(failed)) return Failure{.stage = stage, .reason = "not made", .made_nothing = true};
    const Record record = Record::from_file(failed);
    return Failure{.stage = stage,
                   .reason = record.text("message").value_or("no reason given"),
                   .frame = record.text("frame").value_or(""),
                   .check = record.text("check").value_or(""),
                   .value = record.text("value").value_or(""),
                   .limit = record.text("limit").value_or("")};
  }
  return std::nullopt;
}

}  // namespace tacipc
