#include "common/sample/dataset_plan.h"

#include <vector>

#include "common/base/error.h"
#include "common/format/csv.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

constexpr PlanColumn kColumns[] = {
    {"id", &PlannedRow::id, "sensor, object, motion and index; its name everywhere"},
    {"index", &PlannedRow::index, "count in the whole dataset"},
    {"split", &PlannedRow::split, "train, val or test, by object"},
    {"split_pose", &PlannedRow::split_pose, "the same by pose"},
    {"seed", &PlannedRow::seed, "of the sample's draws and noise"},
    {"sensor", &PlannedRow::sensor, "name of the sensor"},
    {"mesh", &PlannedRow::mesh, "name of the gel's mesh"},
    {"object", &PlannedRow::object, "name of the object"},
    {"motion", &PlannedRow::motion, "name of the motion"},
    {"shard", &PlannedRow::shard, "shard that it is packed into"},
    {"folder", &PlannedRow::folder, "folder, relative to the dataset's"},
};

}  // namespace

std::span<const PlanColumn> plan_columns() { return kColumns; }

std::string plan_header() {
  std::vector<std::string> names;
  for (const PlanColumn& column : kColumns) names.emplace_back(column.name);
  return csv_line(names);
}

std::string plan_line(const PlannedRow& row) {
  std::vector<std::string> fields;
  for (const PlanColumn& column : kColumns) fields.push_back(row.*column.value);
  return csv_line(fields);
}

void for_each_planned(const fs::path& samples_csv, const std::optional<std::string>& shard,
                      const std::function<void(const PlannedRow&)>& use) {
  CsvReader rows(samples_csv);
  bool found = false;
  while (rows.next()) {
    if (shard && rows["shard"] != *shard) continue;
    found = true;
    PlannedRow sample;
    for (const PlanColumn& column : kColumns) sample.*column.value = rows[column.name];
    if (sample.id.empty() || sample.id.find('/') != std::string::npos || sample.id.front() == '.')
      throw DataError("{}:{}: '{}' is not a sample's id", samples_csv.string(), rows.line(), sample.id);
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
