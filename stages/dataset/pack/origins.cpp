#include "stages/dataset/pack/origins.h"

#include <fmt/core.h>

#include "common/base/error.h"
#include "common/base/files.h"

namespace tacipc {
namespace fs = std::filesystem;

std::string sensor_id_of(const PlannedRow& plan, const SampleFrames& sample) {
  const fs::path file = sample.press_input("sensor");
  if (file.filename() == plan.sensor + ".yaml") return plan.sensor;
  return plan.sensor + "-" + sample.press().section("inputs").section("sensor").required_text("hash").substr(0, 8);
}

void Origins::add_file(Files& files, const std::string& name, const std::string& role, const File& file) {
  const auto [known, added] = files[name].emplace(role, file);
  if (!added && known->second.hash != file.hash)
    throw DataError("{} '{}' is two different files: {} and {}", role, name, known->second.path.string(),
                    file.path.string());
}

void Origins::add(const PlannedRow& plan, const std::string& sensor_id, const SampleFrames& sample) {
  const Record inputs = sample.press().section("inputs");
  const auto given = [&](const std::string& flag) {
    return File{sample.press_input(flag), inputs.section(flag).required_text("hash")};
  };
  add_file(sensors_, sensor_id, "sensor", given("sensor"));
  add_file(sensors_, sensor_id, "gel-" + plan.mesh, given("gel"));
  const fs::path markers = sample.arrays().folder() / kMarkersCsv;
  const std::string role = "markers-" + plan.mesh;
  if (fs::exists(markers))
    add_file(sensors_, sensor_id, role,
             {markers, content_hash(markers), fmt::format("sensors/{}/{}.csv", sensor_id, role)});
  if (const auto& reference = sample.sensor().reference_image)
    add_file(sensors_, sensor_id, "reference", {*reference, content_hash(*reference)});
  add_file(objects_, plan.object, "object", given("object"));
  if (inputs.has("object-config")) add_file(objects_, plan.object, "object-config", given("object-config"));
  const fs::path report = sample.press_input("object").parent_path() / "decimate.yaml";
  if (fs::exists(report)) add_file(objects_, plan.object, "decimate", {report, content_hash(report)});
  versions_.insert("press " + sample.press().required_text("version"));
  versions_.insert("render " + sample.render().required_text("version"));
  const Record limits = sample.press_summary().section(&PressSummary::limits).record();
  Value::Map numbers;
  for (const std::string& name : limits.keys()) numbers.emplace_back(name, limits.required_number(name));
  limits_[to_yaml(numbers)] = numbers;
}

Value::List Origins::lines_of(const Files& files, const fs::path& folder) {
  Value::List list;
  for (const auto& [name, roles] : files) {
    Value::List parts;
    for (const auto& [role, file] : roles) {
      const std::string path = file.copy.empty() ? fs::proximate(file.path, folder).generic_string() : file.copy;
      parts.emplace_back(Value::Map{{"role", role}, {"path", path}, {"hash", file.hash}});
    }
    list.emplace_back(Value::Map{{"id", name}, {"files", std::move(parts)}});
  }
  return list;
}

std::map<std::string, fs::path> Origins::copies() const {
  std::map<std::string, fs::path> copies;
  for (const auto& [name, roles] : sensors_)
    for (const auto& [role, file] : roles)
      if (!file.copy.empty()) copies.emplace(file.copy, file.path);
  return copies;
}

Value::Map Origins::lines(const fs::path& folder) const {
  Value::List versions, limits;
  for (const std::string& version : versions_) versions.emplace_back(version);
  for (const auto& [text, numbers] : limits_) limits.emplace_back(numbers);
  return {{"sensors", lines_of(sensors_, folder)},
          {"objects", lines_of(objects_, folder)},
          {"versions", std::move(versions)},
          {"limits", std::move(limits)}};
}

}  // namespace tacipc
