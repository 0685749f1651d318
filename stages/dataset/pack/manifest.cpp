#include "stages/dataset/pack/manifest.h"

#include <fmt/core.h>

#include "common/base/packed_units.h"
#include "common/base/sha256.h"
#include "common/sample/sample_status.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

/// Visits all columns of the plan except the folder, which users of the dataset do not have.
template <typename Use>
void for_each_column(Use&& use) {
  for (const PlanColumn& column : plan_columns())
    if (column.value != &PlannedRow::folder) use(column);
}

/// Fields of both kinds of samples.
std::vector<std::string> planned(const PlannedRow& plan) {
  std::vector<std::string> fields;
  for_each_column([&](const PlanColumn& column) { fields.push_back(plan.*column.value); });
  return fields;
}

/// Name of the grasp and of the finger; empty if a sample is neither.
std::vector<std::string> planned_grasp(const PlannedRow& plan) {
  const fs::path folder = plan.folder;
  if (!is_finger(folder)) return {"", ""};
  return {folder.parent_path().filename().string(), folder.filename().string()};
}

std::string number(double value) { return fmt::format("{}", value); }

/// Columns of labels and numbers from the record of a grasp; empty without a grasp.
constexpr const char* kGraspColumns[] = {"outcome",
                                         "reason",
                                         "first_slip_s",
                                         "gross_slip_s",
                                         "end_slip_mm",
                                         "end_turn_deg",
                                         "mu",
                                         "object_mass_g",
                                         "grip_N",
                                         "friction_margin",
                                         "lever_mm",
                                         "center_of_mass_shift_x_mm",
                                         "center_of_mass_shift_y_mm",
                                         "center_of_mass_shift_z_mm"};

std::vector<std::string> grasp_fields(const SampleFrames& sample) {
  using Lines = GraspSummary;
  const auto grasp = sample.grasp_summary();
  const auto slip = sample.slip();
  const auto or_nothing = [](std::optional<double> value) { return value ? number(*value) : std::string(); };
  std::vector<std::string> fields{grasp.required(&Lines::outcome),
                                  grasp.find(&Lines::reason).value_or(""),
                                  or_nothing(slip.find(&SlipLines::first_slip_s)),
                                  or_nothing(slip.find(&SlipLines::gross_slip_s)),
                                  number(kMmPerM * grasp.required(&Lines::slip_m)),
                                  number(kDegPerRad * grasp.required(&Lines::turn_rad)),
                                  number(grasp.required(&Lines::friction_coefficient)),
                                  number(1e3 * grasp.required(&Lines::object_mass_kg)),
                                  number(grasp.required(&Lines::grip_n)),
                                  or_nothing(grasp.find(&Lines::friction_margin)),
                                  number(kMmPerM * grasp.section(&Lines::pose).required(&HeldPoseLines::lever_m))};
  for (const double shift_m : grasp.required(&Lines::center_of_mass_shift_m))
    fields.push_back(number(kMmPerM * shift_m));
  return fields;
}

}  // namespace

std::vector<std::string> manifest_columns() {
  std::vector<std::string> columns;
  for_each_column([&](const PlanColumn& column) { columns.emplace_back(column.name); });
  for (const char* name :
       {"offset", "status", "sensor_id", "n_frames", "press_frames", "press_force_N", "tangential_force_N",
        "max_indentation_mm", "min_distance_mm", "min_volume_ratio", "max_force_balance_rel", "newton_iterations",
        "clipped_fraction", "press_sha256", "render_sha256", "grasp", "finger"})
    columns.emplace_back(name);
  columns.insert(columns.end(), std::begin(kGraspColumns), std::end(kGraspColumns));
  return columns;
}

std::vector<std::string> manifest_row(const PlannedRow& plan, const std::string& sensor_id, std::size_t offset,
                                      const SampleFrames& sample) {
  using Lines = PressSummary;
  const auto press = sample.press_summary();
  const Record render = sample.render().section("summary");
  const auto distance_m = press.find(&Lines::min_distance_m);
  std::vector<std::string> row = planned(plan);
  for (const std::string& field :
       {fmt::format("{}", offset), std::string("made"), sensor_id, fmt::format("{}", sample.frames().size()),
        fmt::format("{}", sample.press_frames()), number(press.required(&Lines::press_force_n)),
        number(press.required(&Lines::tangential_force_n)), number(render.required_number("max_indentation_mm")),
        distance_m ? number(kMmPerM * *distance_m) : "", number(press.required(&Lines::min_volume_ratio)),
        number(press.required(&Lines::max_balance_relative)), number(press.number(&Lines::newton_iterations)),
        number(render.required_number("clipped_fraction")), sha256_of_file(sample.folder() / "press/press.yaml"),
        sha256_of_file(sample.folder() / "render/render.yaml")})
    row.push_back(field);
  for (const std::string& field : planned_grasp(plan)) row.push_back(field);
  if (sample.grasp())
    for (std::string& field : grasp_fields(sample)) row.push_back(std::move(field));
  row.resize(manifest_columns().size());
  return row;
}

std::vector<std::string> manifest_row(const PlannedRow& plan, const Failure& failure) {
  std::vector<std::string> row = planned(plan);
  row.emplace_back();
  row.emplace_back(failure.made_nothing ? "unmade" : "failed");
  row.resize(manifest_columns().size() - std::size(kGraspColumns) - 2);
  for (const std::string& field : planned_grasp(plan)) row.push_back(field);
  row.resize(manifest_columns().size());
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
