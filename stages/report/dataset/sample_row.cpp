#include "stages/report/dataset/sample_row.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/error.h"
#include "common/npy.h"
#include "stages/report/press_folder.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// Whether somebody holds the lock that a sample's make takes.
bool is_locked(const fs::path& lock) {
  const int file = ::open(lock.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool held = ::flock(file, LOCK_SH | LOCK_NB) != 0;
  ::close(file);
  return held;
}

/// Of a force near zero the ratio is noise.
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

/// From the poses; where those were dropped, what was asked for.
std::optional<double> largest_turn_deg(const fs::path& press_folder, const Record& press) {
  const fs::path path = press_folder / "object_pose.npy";
  if (fs::is_regular_file(path)) {
    const NpyArray poses = read_npy(path);
    if (poses.shape.size() != 3 || poses.shape[1] != 4 || poses.shape[2] != 4)
      throw DataError("{}: does not hold 4 x 4 poses", path.string());
    double largest = 0.0;
    for (std::size_t i = 1; i < poses.shape[0]; ++i) {
      const double turn = turn_about_z_deg(poses.data.data(), poses.data.data() + 16 * i);
      if (std::abs(turn) > std::abs(largest)) largest = turn;
    }
    return largest;
  }
  double turn = 0.0;
  for (const Record& phase : press.section("config").section("sample").one_or_many("motion")) {
    if (phase.text("kind") == "path") return std::nullopt;
    if (phase.text("kind") == "twist") turn += phase.number("angle_deg").value_or(0.0);
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

std::optional<StageTimings> timings_if_there(const fs::path& file) {
  if (!fs::is_regular_file(file)) return std::nullopt;
  return read_timings(file);
}

SampleRow read_row(const PlannedRow& plan, const fs::path& dataset, SampleStatus status) {
  SampleRow row{.plan = plan, .status = status, .numbers = {}};
  const fs::path folder = dataset / plan.folder;
  row.dropped = was_dropped(folder / "press") || was_dropped(folder / "render");
  try {
    row.press = timings_if_there(folder / "press/press.timings.yaml");
    row.render = timings_if_there(folder / "render/render.timings.yaml");
    if (status == SampleStatus::failed) row.failure = failure_of(folder);
    if (status == SampleStatus::made) read_numbers(folder, row);
  } catch (const std::runtime_error& error) {
    row.status = SampleStatus::failed;
    row.numbers = {};
    row.failure = Failure{.stage = "report", .reason = error.what()};
  }
  return row;
}

double turn_about_z_deg(const double* first, const double* second) {
  // Entry (i, j) of second × firstᵀ, of the 3 × 3 turns.
  const auto entry = [&](int i, int j) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += second[4 * i + k] * first[4 * j + k];
    return sum;
  };
  constexpr double kNothingDeg = 1e-9;  // rounding of a motion that does not turn
  const double turn = std::atan2(entry(1, 0) - entry(0, 1), entry(0, 0) + entry(1, 1)) * 180.0 / std::numbers::pi;
  return std::abs(turn) < kNothingDeg ? 0.0 : turn;
}

}  // namespace tacipc
