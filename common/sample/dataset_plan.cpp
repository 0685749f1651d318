#include "common/sample/dataset_plan.h"

#include <algorithm>
#include <vector>

#include "common/base/error.h"
#include "common/base/parse.h"
#include "common/base/printable.h"
#include "common/sample/sample_status.h"

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

constexpr std::size_t kLongestName = 200;     // bytes, including for file names that contain an id
constexpr std::size_t kLongestFolder = 1000;  // bytes

bool has_control(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}

bool is_id(const std::string& text) {
  return !text.empty() && text.size() <= kLongestName && text.front() != '.' && text.find('/') == std::string::npos &&
         !has_control(text);
}

bool is_folder_below(const std::string& text) {
  const fs::path path(text);
  return !text.empty() && text.size() <= kLongestFolder && path.is_relative() && !has_control(text) &&
         std::all_of(path.begin(), path.end(),
                     [](const fs::path& part) { return part != ".." && part.string().size() <= kLongestName; });
}

bool is_whole(const std::string& text) { return parse_number<std::uint64_t>(text).has_value(); }

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

PlannedRow planned_row(const CsvReader& rows, const fs::path& samples_csv) {
  PlannedRow row;
  for (const PlanColumn& column : kColumns) row.*column.value = rows[column.name];
  const auto require = [&](bool good, const std::string& value, const char* what) {
    if (!good) throw DataError("{}:{}: '{}' is not {}", samples_csv.string(), rows.line(), excerpt(value), what);
  };
  require(is_id(row.id), row.id, "a sample's id");
  require(is_folder_below(row.folder), row.folder, "a folder below the dataset's");
  require(is_whole(row.index), row.index, "an index, a whole number from 0");
  require(is_whole(row.seed), row.seed, "a seed, a whole number from 0 to 2^64 - 1");
  return row;
}

void for_each_planned(const fs::path& samples_csv, const std::optional<std::string>& shard,
                      const std::function<void(const PlannedRow&)>& use) {
  CsvReader rows(samples_csv);
  bool found = false;
  while (rows.next()) {
    if (shard && rows["shard"] != *shard) continue;
    found = true;
    use(planned_row(rows, samples_csv));
  }
  if (shard && !found) throw DataError("{}: has no shard '{}'", samples_csv.string(), *shard);
}

std::optional<Failure> failure_of(const fs::path& sample_folder) {
  for (const std::string stage : {"press", "render"}) {
    const fs::path folder = sample_folder / stage;
    if (fs::exists(folder / (stage + ".yaml"))) continue;
    const fs::path failed = stage_file(sample_folder, stage, ".failed.yaml");
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
