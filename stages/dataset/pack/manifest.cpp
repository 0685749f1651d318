#include "stages/dataset/pack/manifest.h"

#include <fmt/core.h>

#include "common/base/packed_units.h"
#include "common/base/sha256.h"
#include "common/sample/sample_status.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

/// Of the plan's columns all but the folder, which nobody has who gets the dataset.
template <typename Use>
void for_each_column(Use&& use) {
  for (const PlanColumn& column : plan_columns())
    if (column.value != &PlannedRow::folder) use(column);
}

/// What both kinds of sample have.
std::vector<std::string> planned(const PlannedRow& plan) {
  std::vector<std::string> fields;
  for_each_column([&](const PlanColumn& column) { fields.push_back(plan.*column.value); });
  return fields;
}

/// Name of the grasp and of the finger; empty where a sample is none.
std::vector<std::string> planned_grasp(const PlannedRow& plan) {
  const fs::path folder = plan.folder;
  if (!is_finger(folder)) return {"", ""};
  return {folder.parent_path().filename().string(), folder.filename().string()};
}

std::string number(double value) { return fmt::format("{}", value); }

}  // namespace

std::vector<std::string> manifest_columns() {
  std::vector<std::string> columns;
  for_each_column([&](const PlanColumn& column) { columns.emplace_back(column.name); });
  for (const char* name :
       {"offset", "status", "sensor_id", "n_frames", "press_frames", "press_force_N", "tangential_force_N",
        "max_indentation_mm", "min_distance_mm", "min_volume_ratio", "max_force_balance_rel", "newton_iterations",
        "clipped_fraction", "press_sha256", "render_sha256", "grasp", "finger", "outcome"})
    columns.emplace_back(name);
  return columns;
}

std::vector<std::string> manifest_row(const PlannedRow& plan, const std::string& sensor_id, std::size_t offset,
                                      const SampleFrames& sample) {
  const Record press = sample.press().section("summary"), render = sample.render().section("summary");
  std::vector<std::string> row = planned(plan);
  for (const std::string& field :
       {fmt::format("{}", offset), std::string("made"), sensor_id, fmt::format("{}", sample.frames().size()),
        fmt::format("{}", sample.press_frames()), number(press.required_number("press_force_n")),
        number(press.required_number("tangential_force_n")), number(render.required_number("max_indentation_mm")),
        number(kMmPerM * press.required_number("min_distance_m")), number(press.required_number("min_volume_ratio")),
        number(press.required_number("max_balance_relative")), number(press.required_number("newton_iterations")),
        number(render.required_number("clipped_fraction")), sha256_of_file(sample.folder() / "press/press.yaml"),
        sha256_of_file(sample.folder() / "render/render.yaml")})
    row.push_back(field);
  for (const std::string& field : planned_grasp(plan)) row.push_back(field);
  row.push_back(sample.grasp() ? sample.grasp()->section("summary").required_text("outcome") : "");
  return row;
}

std::vector<std::string> manifest_row(const PlannedRow& plan, const Failure& failure) {
  std::vector<std::string> row = planned(plan);
  row.emplace_back();
  row.emplace_back(failure.made_nothing ? "unmade" : "failed");
  row.resize(manifest_columns().size() - 3);
  for (const std::string& field : planned_grasp(plan)) row.push_back(field);
  row.emplace_back();  // outcome
  return row;
}

std::vector<std::string> failure_columns() {
  return {"id", "stage", "reason", "frame", "check", "value", "limit", "log"};
}

std::vector<std::string> failure_row(const PlannedRow& plan, const Failure& failure) {
  return {
      plan.id,       failure.stage, failure.reason, failure.frame,
      failure.check, failure.value, failure.limit,  stage_file(plan.folder, failure.stage, ".log").generic_string()};
}

std::vector<std::string> timing_columns() {
  std::vector<std::string> columns{"id"};
  for (const std::string stage : {"press", "render"})
    for (const char* what : {"_threads", "_wall_s", "_processor_s", "_peak_memory_mb"}) columns.push_back(stage + what);
  return columns;
}

std::vector<std::string> timing_row(const std::string& id, const fs::path& sample_folder) {
  std::vector<std::string> row{id};
  for (const std::string stage : {"press", "render"}) {
    std::optional<Record> record;
    if (const auto path = timings_file(sample_folder, stage)) record = Record::from_file(*path);
    for (const char* key : {"threads", "wall_s", "processor_s", "peak_memory_mb"})
      row.push_back(record ? record->text(key).value_or("") : "");
  }
  return row;
}

}  // namespace tacipc
