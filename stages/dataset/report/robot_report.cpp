#include "stages/dataset/report/robot_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>

#include "common/base/error.h"
#include "common/format/csv.h"
#include "common/sample/scene_hold.h"
#include "common/stage/record.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// Name of a step: its first action, in a word or two.
std::string step_name(const Record& step, std::size_t number) {
  std::string what = "hold";
  if (step.has("set")) {
    const std::vector<std::string> actuators = step.section("set").keys();
    what = actuators.size() == 1 ? actuators[0] : "set";
  }
  for (const char* kind : {"move", "shake"}) {
    if (step.has(kind)) what = kind;
  }
  return fmt::format("{} {}", number, what);
}

template <typename T>
T number_in(const CsvReader& table, const fs::path& file, std::string_view column) {
  const std::string& text = table[column];
  T value{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size())
    throw DataError("{}:{}: {}: expected a number, found '{}'", file.string(), table.line(), column, text);
  return value;
}

std::vector<CouplingTry> read_tries(const fs::path& file) {
  std::vector<CouplingTry> tries;
  CsvReader table(file);
  while (table.next())
    tries.push_back({.window = number_in<int>(table, file, "window"),
                     .frames = number_in<int>(table, file, "frames"),
                     .number = number_in<int>(table, file, "try"),
                     .residual_n = number_in<double>(table, file, "residual_n"),
                     .residual_relative = number_in<double>(table, file, "residual_relative"),
                     .stiffness_n_m = number_in<double>(table, file, "stiffness_n_m"),
                     .apart_m = table["apart_m"].empty() ? std::nullopt
                                                         : std::optional(number_in<double>(table, file, "apart_m"))});
  // Iterations of a halved window follow those with more frames, regardless of the order of the lines.
  std::stable_sort(tries.begin(), tries.end(), [](const CouplingTry& a, const CouplingTry& b) {
    return a.window != b.window ? a.window < b.window : a.frames > b.frames;
  });
  return tries;
}

}  // namespace

fs::path robot_folder(const fs::path& scene) { return scene / "robot"; }

std::optional<RobotReport> read_robot_report(const fs::path& scene) {
  const fs::path folder = robot_folder(scene), file = folder / "robot.yaml", residuals = scene / "residuals.csv";
  if (!fs::is_regular_file(file)) return std::nullopt;
  const Record record = Record::from_file(file), task = record.section("task"), drawn = record.section("variables");
  RobotReport robot{.task = record.text("name").value_or(""),
                    .seed = record.text("seed").value_or(""),
                    .variables = {},
                    .steps = {},
                    .motion = read_robot_folder(folder),
                    .tries = {}};
  for (const std::string& name : drawn.keys()) robot.variables.emplace_back(name, drawn.required_number(name));
  for (const Record& step : task.one_or_many("steps")) robot.steps.push_back(step_name(step, robot.steps.size() + 1));
  robot.held = read_held(scene);
  robot.tolerance = task.section("coupling").number("tolerance").value_or(robot.tolerance);
  if (fs::is_regular_file(residuals)) robot.tries = read_tries(residuals);
  return robot;
}

}  // namespace tacipc
