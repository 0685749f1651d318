#include "stages/study/identify/fitted_sensor.h"

#include <fmt/format.h>

#include <regex>
#include <sstream>

#include "common/config/config_text.h"

namespace tacipc {
namespace {

/// Key of the sensor file for a parameter of the mechanics.
std::string sensor_key(const std::string& name) {
  if (name == kModulus || name == kPoisson) return "material." + name;
  if (name == kThickness) return "gel." + name;
  if (name == kFriction) return "gel.friction";
  if (name == kMount) return "mount.compliance_mm_per_n";
  if (name == kShearMount) return "mount.shear_compliance_mm_per_n";
  return {};
}

std::string terms_yaml(const IdentifySpec& spec, const Unknowns& unknowns, const Eigen::VectorXd& u) {
  std::string out = "[";
  for (const auto& [part, time] : spec.relaxation)
    out += fmt::format("{}{{part: {:.6g}, time_s: {:.6g}}}", out.size() > 1 ? ", " : "",
                       unknowns.value(u, part.name, {}, 0.0), unknowns.value(u, time.name, {}, 0.0));
  return out + "]";
}

std::string path_of(const std::string& section, const std::string& key) {
  return section.empty() ? key : section + "." + key;
}

}  // namespace

std::map<std::string, std::string> sensor_changes(const MechanicsModel& model, const Eigen::VectorXd& u) {
  std::map<std::string, std::string> out;
  for (Eigen::Index i = 0; i < model.unknowns().size(); ++i) {
    const Unknown& unknown = model.unknowns()[i];
    const std::string key = unknown.measurement.empty() ? sensor_key(unknown.name) : "";
    if (!key.empty()) out[key] = fmt::format("{:.6g}", unknown.value_of(u[i]));
  }
  if (!model.spec().relaxation.empty()) out["material.relaxation"] = terms_yaml(model.spec(), model.unknowns(), u);
  return out;
}

std::string fitted_sensor(const std::string& text, const std::string& name, const IdentifyResult& result) {
  ConfigText file(text, name);
  std::map<std::string, std::string> said;  // key → note
  const auto put = [&](const std::string& key, const std::string& yaml) {
    ConfigReader in = ConfigReader::from_text(file.text(), name);
    const std::string section = key.substr(0, key.find('.')), inner = key.substr(key.find('.') + 1);
    const bool there = in.has(section) && in.section(section).has(inner);
    there ? file.set(key, yaml) : file.add(key, yaml);
  };
  for (const auto& [key, yaml] : sensor_changes(result.model, result.u)) {
    put(key, yaml);
    put(key + "_src", "derived");
    std::string deviation;
    for (const Estimate& e : result.estimates)
      if (e.measurement.empty() && sensor_key(e.name) == key)
        deviation = " ± " + deviation_text(e.sigma) + (e.told ? "" : ", by its prior");
    said[key] = "[fitted" + deviation + "]";
  }
  ConfigReader in = ConfigReader::from_text(file.text(), name);
  const Sensor sensor = Sensor::read(in);
  in.finish();
  for (const auto& [path, source] : sensor.sources)
    said.emplace(path, source == "known" ? "[measured]" : source == "derived" ? "[derived]" : "[guess]");
  // A note of an earlier fit is replaced.
  static const std::regex section_line(R"(^(\w+):\s*(#.*)?$)"),
      value_line(R"(^  (\w+): ([^#]*[^# ])\s*(#\s?(\[[^\]]*\]\s?)?(.*))?$)");
  std::string out, section, line;
  std::istringstream lines(file.text());
  while (std::getline(lines, line)) {
    std::smatch match;
    if (std::regex_match(line, match, section_line))
      section = match[1];
    else if (!line.empty() && line[0] != ' ' && line[0] != '#')
      section.clear();
    const bool mechanics = section == "gel" || section == "material" || section == "mount";
    if (mechanics && std::regex_match(line, match, value_line)) {
      const auto note = said.find(path_of(section, match[1]));
      const std::string old = note != said.end() && note->second.starts_with("[fitted") ? "" : match[5].str();
      if (note != said.end())
        line =
            fmt::format("  {}: {}  # {}{}", match[1].str(), match[2].str(), note->second, old.empty() ? "" : " " + old);
    }
    out += line + '\n';
  }
  return out;
}

Ensemble ensemble_of(const IdentifyResult& result, const std::filesystem::path& sensor, int members) {
  Ensemble out{.title = "drawn from what " + result.model.spec().title + " left uncertain", .sensor = sensor};
  for (const Eigen::Index column : result.posterior.resampled(members)) {
    EnsembleMember member{.name = fmt::format("m{:02}", out.members.size())};
    for (const auto& change : sensor_changes(result.model, result.posterior.u.col(column)))
      member.set.push_back(change);
    out.members.push_back(std::move(member));
  }
  return out;
}

}  // namespace tacipc
