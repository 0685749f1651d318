#include "common/sample/ensemble.h"

#include <fmt/format.h>

#include <set>

#include "common/base/files.h"
#include "common/base/value.h"
#include "common/config/config_text.h"
#include "common/sensor/sensor.h"

namespace tacipc {
namespace fs = std::filesystem;

Ensemble Ensemble::read(ConfigReader& in) {
  Ensemble ensemble{.title = in.text("title"),
                    .sensor = (fs::path(in.source()).parent_path() / in.text("sensor")).lexically_normal()};
  std::set<std::string> names;
  for (ConfigReader& item : in.sections("members")) {
    EnsembleMember member{.name = item.file_name("name")};
    if (member.name == kNominal) item.fault("name", fmt::format("{} is the sensor as its file says", kNominal));
    if (!names.insert(member.name).second) item.fault("name", "is given twice");
    ConfigReader set = item.section("set");
    for (const std::string& key : set.keys()) member.set.emplace_back(key, set.text(key));
    ensemble.members.push_back(std::move(member));
  }
  if (ensemble.members.size() < 2) in.fault("members", "at least two are needed to tell how far they are apart");
  return ensemble;
}

std::string Ensemble::yaml(const fs::path& folder) const {
  std::string text =
      to_yaml(Value::Map{{"title", title}, {"sensor", fs::proximate(sensor, folder).generic_string()}}) + "members:\n";
  for (const EnsembleMember& member : members) {
    text += fmt::format("  - name: {}\n    set:\n", member.name);
    for (const auto& [key, value] : member.set) text += fmt::format("      {}: {}\n", key, value);
  }
  return text;
}

std::string sensor_of(const Ensemble& ensemble, const EnsembleMember& member) {
  const std::string name = fmt::format("{}, member {}", ensemble.sensor.generic_string(), member.name);
  ConfigText text(read_file(ensemble.sensor), name);
  for (const auto& [key, value] : member.set) text.set(key, value);
  ConfigReader in = ConfigReader::from_text(text.text(), name);
  Sensor::read(in);
  in.finish();
  return text.text();
}

DatasetEnsemble DatasetEnsemble::read(ConfigReader& in) {
  return {.title = in.text("title"),
          .sensor = in.text("sensor"),
          .mesh = in.text_or("mesh", ""),
          .members = in.texts("members")};
}

std::string DatasetEnsemble::yaml() const {
  Value::List names(members.begin(), members.end());
  Value::Map lines{{"title", title}, {"sensor", sensor}};
  if (!mesh.empty()) lines.emplace_back("mesh", mesh);
  lines.emplace_back("members", std::move(names));
  return "# Made by the stage plan.\n" + to_yaml(lines);
}

std::vector<std::string> DatasetEnsemble::presses() const {
  std::vector<std::string> names = members;
  if (!mesh.empty()) names.insert(names.begin(), kNominal);
  return names;
}

std::optional<DatasetEnsemble> ensemble_of_dataset(const fs::path& dataset) {
  const fs::path file = dataset / kEnsembleFile;
  if (!fs::exists(file)) return std::nullopt;
  return read_config<DatasetEnsemble>(file);
}

fs::path member_presses(const fs::path& sample_folder) { return sample_folder / "ensemble"; }

fs::path member_press(const fs::path& sample_folder, const std::string& member) {
  return member_presses(sample_folder) / member / "press";
}

}  // namespace tacipc
