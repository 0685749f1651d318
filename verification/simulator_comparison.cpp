#include "verification/simulator_comparison.h"

#include <fmt/format.h>

#include <array>

#include "common/base/error.h"
#include "verification/stage_record.h"

namespace tacipc::verify {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

/// Every value of a record's configuration by its path.
void flatten(const Value& value, const std::string& path, Settings& out) {
  if (const auto* map = std::get_if<Value::Map>(&value.data())) {
    for (const auto& [key, inner] : *map) flatten(inner, path.empty() ? key : path + "." + key, out);
  } else if (const auto* text = std::get_if<std::string>(&value.data())) {
    out.emplace_back(path, *text);
  } else {
    out.emplace_back(path, to_yaml(Value(Value::Map{{"list", value}})).substr(sizeof("list: ") - 1));
    while (!out.back().second.empty() && out.back().second.back() == '\n') out.back().second.pop_back();
  }
}

std::optional<std::string> value_at(const Settings& settings, const std::string& path) {
  for (const auto& [key, value] : settings)
    if (key == path) return value;
  return std::nullopt;
}

/// Path, value here, value there; "not said" where there is none.
std::vector<std::array<std::string, 3>> differences(const Settings& here, const Settings& there) {
  std::vector<std::array<std::string, 3>> out;
  for (const auto& [path, value] : here)
    if (const auto other = value_at(there, path); other != value)
      out.push_back({path, value, other.value_or("not said")});
  for (const auto& [path, value] : there)
    if (!value_at(here, path)) out.push_back({path, "not said", value});
  return out;
}

}  // namespace

SimulatorComparison SimulatorComparison::read(ConfigReader& in) {
  SimulatorComparison config;
  config.title = in.text("title");
  config.chosen = MarkerChoice::read(in);
  config.motions = in.texts("motions");
  if (config.motions.empty()) in.fault("motions", "name at least one");
  for (ConfigReader& simulator : in.sections("simulators"))
    config.simulators.push_back({.name = simulator.text("name"), .label = simulator.text("label")});
  if (config.simulators.size() < 2) in.fault("simulators", "name at least two");
  config.reported_below = in.number("reported_below", Range::positive());
  return config;
}

SimulatorRun SimulatorRun::read(const std::filesystem::path& folder) {
  SimulatorRun run;
  run.name = folder.lexically_normal().filename().string();
  for (const char* stage : {"press", "mpm"}) {
    const auto failure = why_no_record(folder, stage);
    const bool failed = failure && std::filesystem::exists(folder / (std::string(stage) + ".failed.yaml"));
    if (failed) run.failure = *failure;
    if (failure) continue;
    ConfigReader record = ConfigReader::from_file(folder / (std::string(stage) + ".yaml"));
    run.stage = stage;
    run.name = record.text("name");
    flatten(record.section("config").section("config").content(), "", run.settings);
    ConfigReader summary = record.section("summary");
    run.half_speed_change = summary.optional_number("marker_change_at_half_speed");
    run.mach = summary.optional_number("largest_mach");
    run.motion = read_other_motion(folder);
    run.motion->name = run.name;
    run.failure.clear();
    return run;
  }
  if (run.failure.empty()) run.failure = "left no record";
  return run;
}

std::string differing_settings(const SimulatorRun& run, const SimulatorRun& from) {
  std::string out;
  for (const auto& [path, value, other] : differences(run.settings, from.settings))
    out += fmt::format("{}`{}` {} ({})", out.empty() ? "" : ", ", path, value, other);
  return out;
}

const SimulatorRun* nearest_run(const SimulatorRun& run, const std::vector<const SimulatorRun*>& others) {
  const SimulatorRun* nearest = nullptr;
  std::size_t fewest = 0;
  for (const SimulatorRun* other : others) {
    if (other->stage != run.stage || !other->motion) continue;
    const std::size_t count = differences(run.settings, other->settings).size();
    if (nearest && count >= fewest) continue;
    nearest = other;
    fewest = count;
  }
  return nearest;
}

}  // namespace tacipc::verify
