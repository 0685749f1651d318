#include "stages/dataset/plan/choices.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <tuple>

#include "common/base/error.h"
#include "common/base/files.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

fs::path beside(const fs::path& file, const std::string& name) {
  return (file.parent_path() / name).lexically_normal();
}

/// Sensors and photographs that variants of render name. Render itself checks the rest.
std::vector<ChosenFile> files_of_variants(const fs::path& render) {
  std::vector<ChosenFile> files;
  ConfigReader in = ConfigReader::from_file(render);
  int number = 0;
  for (ConfigReader& variant : in.sections("variants")) {
    const std::string role = fmt::format("variant_{}_", number++);
    const auto photograph = variant.optional_text("reference_image");
    if (photograph) files.push_back({role + "photograph", beside(render, *photograph)});
    const auto sensor = variant.optional_text("sensor");
    if (!sensor) continue;
    files.push_back({role + "sensor", beside(render, *sensor)});
    const auto of_sensor = read_config<Sensor>(files.back().file).reference_image;
    if (of_sensor && !photograph) files.push_back({role + "photograph", of_sensor->lexically_normal()});
  }
  return files;
}

struct ChosenContent {
  std::string hash, path;
};

std::map<std::string, ChosenContent> parsed(const std::string& text) {
  std::map<std::string, ChosenContent> contents;
  std::istringstream lines(text);
  std::string role;
  ChosenContent content;
  while (lines >> role >> content.hash && std::getline(lines >> std::ws, content.path)) contents[role] = content;
  return contents;
}

struct stat status_of(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) throw DataError("{}: {}", file.string(), std::strerror(errno));
  return status;
}

bool later(const timespec& a, const timespec& b) {
  return std::tie(a.tv_sec, a.tv_nsec) > std::tie(b.tv_sec, b.tv_nsec);
}

/// Time of a choice that replaces the `old` one; nothing: now.
std::optional<timespec> time_of_change(const timespec& old, const std::map<std::string, ChosenContent>& before,
                                       const std::map<std::string, ChosenContent>& after) {
  timespec time = old;
  if (before.size() != after.size()) return std::nullopt;
  for (const auto& [role, content] : after) {
    const auto found = before.find(role);
    if (found == before.end()) return std::nullopt;
    if (found->second.hash == content.hash) continue;
    if (found->second.path != content.path) return std::nullopt;
    const timespec changed = status_of(content.path).st_ctim;
    if (later(changed, time)) time = changed;
  }
  return time;
}

/// Adds gels of an ensemble that the dataset does not use itself. Changes of the sensor by members are in a file on
/// which the gel depends.
void add_members(const DatasetConfig& config, const EnsembleChoice& ensemble, std::vector<Choice>& choices) {
  std::set<std::string> known;
  for (const Choice& choice : choices) known.insert(choice.name);
  for (const SensorChoice& sensor : config.sensors) {
    if (!ensemble.is_of(sensor)) continue;
    for (const std::string& press : ensemble.planned(config.sensors).presses()) {
      Choice gel{"gel-" + ensemble.gel_of(sensor, press),
                 {{"sensor", sensor.sensor}, {"mesh", ensemble.mesh_config.value_or(sensor.mesh_config)}}};
      if (!ensemble.mesh_config && sensor.import) gel.files.push_back({"import", *sensor.import});
      if (known.insert(gel.name).second) choices.push_back(std::move(gel));
    }
  }
}

void write_choice(const Choice& choice, const fs::path& folder) {
  std::string text;
  std::map<std::string, ChosenContent> after;
  for (const ChosenFile& chosen : choice.files) {
    const ChosenContent content{content_hash(chosen.file), fs::canonical(chosen.file).generic_string()};
    text += fmt::format("{} {} {}\n", chosen.role, content.hash, content.path);
    after[chosen.role] = content;
  }
  const fs::path file = folder / choice.name, new_file = folder / ("." + choice.name);
  std::optional<timespec> time;
  std::error_code error;
  if (fs::is_regular_file(file, error)) {
    const std::string old = read_file(file);
    if (old == text) return;
    time = time_of_change(status_of(file).st_mtim, parsed(old), after);
  }
  write_file(new_file, text);
  if (time) {
    const timespec times[] = {*time, *time};
    if (::utimensat(AT_FDCWD, new_file.c_str(), times, 0) != 0)
      throw DataError("{}: {}", new_file.string(), std::strerror(errno));
  }
  flush_to_disk({new_file});
  fs::rename(new_file, file);
}

}  // namespace

std::vector<Choice> choices_of(const DatasetConfig& config, const std::vector<Sensor>& sensors) {
  std::vector<Choice> choices;
  const std::vector<ChosenFile> variants = files_of_variants(config.render);
  for (std::size_t s = 0; s < config.sensors.size(); ++s) {
    const SensorChoice& sensor = config.sensors[s];
    Choice gel{"gel-" + sensor.gel(), {{"sensor", sensor.sensor}, {"mesh", sensor.mesh_config}}};
    if (sensor.import) gel.files.push_back({"import", *sensor.import});
    Choice render{"render-" + sensor.gel(), {{"render", config.render}}};
    if (const auto& photograph = sensors[s].reference_image)
      render.files.push_back({"photograph", photograph->lexically_normal()});
    render.files.insert(render.files.end(), variants.begin(), variants.end());
    choices.push_back(std::move(gel));
    choices.push_back(std::move(render));
  }
  if (config.ensemble) add_members(config, *config.ensemble, choices);
  for (const ObjectChoice& object : config.objects)
    choices.push_back({"object-" + object.name,
                       {{object.embossed ? "pattern" : "mesh", object.file}, {"decimate", config.decimate}}});
  for (const MotionChoice& motion : config.motions) {
    Choice choice{"motion-" + motion.name, {{"press", motion.press}}};
    for (const PhaseTemplate& phase : motion.motion.phases)
      if (!phase.path_file.empty())
        choice.files.push_back({fmt::format("path_{}", choice.files.size()), phase.path_file});
    choices.push_back(std::move(choice));
  }
  return choices;
}

void write_choices(const std::vector<Choice>& choices, const fs::path& folder) {
  for (const Choice& choice : choices) write_choice(choice, folder);
}

}  // namespace tacipc
