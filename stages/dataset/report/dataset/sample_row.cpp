#include "stages/dataset/report/dataset/sample_row.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/sample/press_folder.h"
#include "common/sample/press_record.h"
#include "stages/dataset/report/press_report.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// The ratio is noise for a force near zero.
std::optional<double> largest_shear_ratio(const std::vector<FrameReport>& frames) {
  double largest_n = 0.0;
  for (const FrameReport& frame : frames) largest_n = std::max(largest_n, frame.press_force_n);
  std::optional<double> ratio;
  for (const FrameReport& frame : frames) {
    if (frame.tangential_force_n && frame.press_force_n > 0.01 * largest_n)
      ratio = std::max(ratio.value_or(0.0), *frame.tangential_force_n / frame.press_force_n);
  }
  return ratio;
}

/// Rotation from the poses; if these were dropped, the requested one.
std::optional<double> largest_turn_deg(const fs::path& press_folder, const Record& press) {
  const PressFolder arrays(press_folder);
  if (arrays.has(PressArray::object_pose)) {
    double largest = 0.0;
    const std::vector<Matrix4> poses = arrays.poses();
    for (std::size_t i = 1; i < poses.size(); ++i) {
      const double turn = turn_about_z_deg(poses[0], poses[i]);
      if (std::abs(turn) > std::abs(largest)) largest = turn;
    }
    return largest;
  }
  double turn = 0.0;
  for (const Record& phase : press.section("config").section("sample").one_or_many("motion")) {
    if (phase.text("kind") == name_of(PhaseKind::path)) return std::nullopt;
    if (phase.text("kind") == name_of(PhaseKind::twist)) turn += phase.number("angle_deg").value_or(0.0);
  }
  return turn;
}

void read_numbers(const fs::path& folder, SampleRow& row) {
  const Record press = Record::from_file(folder / "press/press.yaml");
  SampleReport sample;
  read_press_record(press, sample);
  judge_press(press, sample);
  SampleNumbers& numbers = row.numbers;
  for (const FrameReport& frame : sample.frames) {
    numbers.press_force_n = std::max(numbers.press_force_n.value_or(0.0), frame.press_force_n);
    numbers.tangential_force_n = std::max(numbers.tangential_force_n, frame.tangential_force_n);
    numbers.area_mm2 = std::max(numbers.area_mm2, frame.contact_area_mm2);
    numbers.balance_relative = std::max(numbers.balance_relative, frame.balance_relative);
  }
  numbers.shear_ratio = largest_shear_ratio(sample.frames);
  numbers.twist_deg = largest_turn_deg(folder / "press", press);
  numbers.min_distance_m = sample.min_distance_m;
  numbers.min_volume_ratio = sample.min_volume_ratio;
  const Record render = Record::from_file(folder / "render/render.yaml");
  numbers.depth_mm = render.section("summary").required_number("max_indentation_mm");
  if (!is_finger(folder)) return;
  const auto grasp = summary_of<GraspSummary>(Record::from_file(stage_file(folder, "press", ".yaml")));
  row.outcome = grasp.required(&GraspSummary::outcome);
  row.reason = grasp.find(&GraspSummary::reason).value_or("");
}

}  // namespace

std::optional<StageTimings> timings_if_there(const fs::path& file) {
  if (!fs::is_regular_file(file)) return std::nullopt;
  return read_timings(file);
}

SampleRow read_row(const PlannedRow& plan, const fs::path& dataset, SampleStatus status) {
  SampleRow row{.plan = plan, .status = status, .numbers = {}};
  const fs::path folder = dataset / plan.folder;
  row.dropped = was_dropped(folder / "press") || was_dropped(folder / "render");
  try {
    if (const auto file = timings_file(folder, "press")) row.press = read_timings(*file);
    if (const auto file = timings_file(folder, "render")) row.render = read_timings(*file);
    if (status == SampleStatus::failed) row.failure = failure_of(folder);
    if (status == SampleStatus::made) read_numbers(folder, row);
  } catch (const std::runtime_error& error) {
    row.status = SampleStatus::failed;
    row.numbers = {};
    row.outcome = row.reason = "";
    row.failure = Failure{.stage = "report", .reason = error.what()};
  }
  return row;
}

double turn_about_z_deg(const Matrix4& first, const Matrix4& second) {
  // Entry (i, j) of second × firstᵀ, of the 3 × 3 rotations.
  const auto entry = [&](int i, int j) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += second(i, k) * first(j, k);
    return sum;
  };
  constexpr double kNothingDeg = 1e-9;  // rounding of a motion without rotation
  const double turn = std::atan2(entry(1, 0) - entry(0, 1), entry(0, 0) + entry(1, 1)) * 180.0 / std::numbers::pi;
  return std::abs(turn) < kNothingDeg ? 0.0 : turn;
}

}  // namespace tacipc
