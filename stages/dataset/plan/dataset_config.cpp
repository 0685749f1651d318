#include "stages/dataset/plan/dataset_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "common/base/file_name.h"
#include "common/base/text_reader.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// Reads one dataset file, and collects names and paths for the checks.
class Reader {
 public:
  Reader(ConfigReader& in, DatasetConfig& config)
      : in_(in), config_(config), folder_(fs::path(in.source()).parent_path()) {}

  void read() {
    config_.seed = in_.integer("seed", 0);
    config_.low_discrepancy =
        in_.choice_or("sampling", "low_discrepancy", {"low_discrepancy", "random"}) == "low_discrepancy";
    config_.decimate = file_or(in_, "decimate", "configs/objects/decimate/default.yaml");
    config_.render = file_or(in_, "render", "configs/render/default.yaml");
    config_.maps = DatasetMaps::read(in_);
    const fs::path press = file_or(in_, "press", "configs/press/default.yaml");
    for (ConfigReader& item : in_.one_or_more_sections("sensors")) read_sensor(item);
    for (ConfigReader& item : in_.one_or_more_sections("objects")) read_objects(item);
    for (ConfigReader& item : in_.one_or_more_sections("motions")) read_motion(item, press);
    if (auto ensemble = in_.optional_section("ensemble")) read_ensemble(*ensemble);
    if (auto splits = in_.optional_section("splits")) read_splits(*splits);
    read_outputs();
    config_.stop_after_failures = in_.integer_or("stop_after_failures", 10, 1);
    std::sort(config_.named.begin(), config_.named.end());
    config_.named.erase(std::unique(config_.named.begin(), config_.named.end()), config_.named.end());
  }

 private:
  /// Resolves a path of the configuration; make and the shell must accept it as one word.
  fs::path resolved(ConfigReader& in, const std::string& key, const fs::path& given) {
    fs::path path = given.lexically_normal();
    check_path(in, key, path);
    if (!fs::exists(path)) {
      in.fault(key, path.generic_string() + " does not exist");
    } else {
      config_.named.push_back(path);
    }
    return path;
  }

  fs::path file(ConfigReader& in, const std::string& key) { return resolved(in, key, folder_ / in.text(key)); }

  /// Resolves a path, or the default `ours` if the key is absent.
  fs::path file_or(ConfigReader& in, const std::string& key, const fs::path& ours) {
    const std::string given = in.text_or(key, ours.string());
    return resolved(in, key, in.has(key) ? folder_ / given : ours);
  }

  static void check_path(ConfigReader& in, const std::string& key, const fs::path& path) {
    if (!is_plain_path(path.generic_string()))
      in.fault(key, fmt::format("'{}' {}", path.generic_string(), kPlainPathRule));
  }

  /// Checks a part of a sample's name. Parts are joined by two underscores, so they must not contain these.
  void check_part(ConfigReader& in, const std::string& key, const std::string& name) {
    if (!is_file_name(name)) return in.fault(key, fmt::format("'{}': {}", name, kFileNameRule));
    if (name.find("__") != std::string::npos || name.front() == '_' || name.back() == '_')
      in.fault(key, "'" + name + "' begins or ends with an underscore, or has two in a row");
  }

  void read_sensor(ConfigReader& item) {
    SensorChoice choice;
    choice.sensor = file(item, "sensor");
    choice.mesh_config = file(item, "mesh");
    choice.name = choice.sensor.stem().string();
    choice.mesh = choice.mesh_config.stem().string();
    if (item.has("import")) choice.import = file(item, "import");
    check_part(item, "sensor", choice.name);
    if (!gels_.insert(choice.gel()).second) item.fault("sensor", "a sensor and mesh of this name exist already");
    config_.sensors.push_back(std::move(choice));
  }

  void read_objects(ConfigReader& item) {
    const bool emboss = item.has("emboss");
    if (emboss == item.has("meshes")) {
      item.fault(emboss ? "meshes" : "", "give either emboss or meshes");
      item.ignore("emboss"), item.ignore("meshes");
      return;
    }
    const std::string key = emboss ? "emboss" : "meshes";
    const fs::path path = file(item, key);
    ObjectChoice choice{.name = "", .file = "", .embossed = emboss, .spec = {.unit = "m", .up = "-z"}};
    if (!emboss) {
      choice.spec = ObjectSpec::read(item);
      // Objects of a dataset are the same in all of its sensors, so no field of view can decide.
      if (choice.spec.fit_window) item.fault("scale", "fit is for one sensor; give a number");
      if (choice.spec.height_field && choice.spec.height_field->side == SideConfig::kMostRelief)
        item.fault("height_field", "most_relief is for one sensor; name a side");
    }
    std::vector<fs::path> files;
    const std::set<std::string> endings =
        emboss ? std::set<std::string>{".yaml"}
               : std::set<std::string>{".stl", ".obj", ".off", ".ply", ".glb", ".gltf", ".3mf"};
    if (fs::is_directory(path)) {
      for (const auto& entry : fs::directory_iterator(path))
        if (endings.contains(lower_case(entry.path().extension().string()))) files.push_back(entry.path());
      std::sort(files.begin(), files.end());
      if (files.empty())
        item.fault(key, path.generic_string() + " has no " + (emboss ? "patterns" : "meshes") + " in it");
    } else {
      files.push_back(path);
    }
    const std::vector<std::string> only = item.texts("only");
    for (const std::string& name : only)
      if (std::none_of(files.begin(), files.end(), [&](const fs::path& f) { return f.stem() == name; }))
        item.fault("only", path.generic_string() + " has no " + name);
    for (const fs::path& found : files) {
      choice.name = found.stem().string();
      if (!only.empty() && std::find(only.begin(), only.end(), choice.name) == only.end()) continue;
      choice.file = found;
      check_part(item, key, choice.name);
      check_path(item, key, found);
      if (!objects_.insert(choice.name).second) item.fault(key, choice.name + " exists already");
      config_.named.push_back(found);
      config_.objects.push_back(choice);
    }
  }

  void read_motion(ConfigReader& item, const fs::path& press) {
    MotionChoice choice;
    choice.name = item.text("name");
    check_part(item, "name", choice.name.empty() ? "_" : choice.name);
    choice.samples = item.integer("samples", 1, 999999);
    choice.press = item.has("press") ? file(item, "press") : press;
    if (item.has("file")) {
      const fs::path path = file(item, "file");
      if (fs::is_regular_file(path)) {
        ConfigReader in = ConfigReader::from_file(path);
        choice.motion = MotionTemplate::read(in);
        in.finish();
      }
    } else {
      choice.motion = MotionTemplate::read(item);
    }
    for (const PhaseTemplate& phase : choice.motion.phases)
      if (!phase.path_file.empty()) {
        check_path(item, "motion", phase.path_file);
        config_.named.push_back(phase.path_file);
      }
    if (!motions_.insert(choice.name).second) item.fault("name", "is given twice");
    config_.motions.push_back(std::move(choice));
  }

  void read_ensemble(ConfigReader& in) {
    EnsembleChoice choice;
    choice.file = file(in, "file");
    const auto members = static_cast<std::size_t>(in.integer_or("members", 4, 2, 1000));
    if (in.has("mesh")) choice.mesh_config = file(in, "mesh");
    if (!fs::is_regular_file(choice.file)) return;
    ConfigReader content = ConfigReader::from_file(choice.file);
    choice.ensemble = Ensemble::read(content);
    content.finish();
    auto& all = choice.ensemble.members;
    if (all.size() < members)
      in.fault("members",
               std::to_string(members) + " are more than the " + std::to_string(all.size()) + " of the file");
    all.resize(std::min(all.size(), members));
    if (std::none_of(config_.sensors.begin(), config_.sensors.end(),
                     [&](const SensorChoice& sensor) { return choice.is_of(sensor); }))
      in.fault("file",
               "is of the sensor " + choice.ensemble.sensor.generic_string() + ", which is none of this dataset");
    config_.ensemble = std::move(choice);
  }

  void read_splits(ConfigReader& splits) {
    config_.splits.val = splits.number_or("val", 0.0, Range{.low = 0.0, .high = 1.0, .open_high = true});
    config_.splits.test = splits.number_or("test", 0.0, Range{.low = 0.0, .high = 1.0, .open_high = true});
    if (!(config_.splits.val + config_.splits.test < 1.0))
      splits.fault("test", "val and test leave nothing to train on");
    config_.splits.val_objects = splits.texts("val_objects");
    config_.splits.test_objects = splits.texts("test_objects");
    std::set<std::string> seen;
    for (const auto& [key, list] :
         {std::pair{"val_objects", &config_.splits.val_objects}, {"test_objects", &config_.splits.test_objects}})
      for (const std::string& name : *list) {
        if (!objects_.contains(name)) splits.fault(key, name + " is not one of the objects");
        if (!seen.insert(name).second) splits.fault(key, name + " is named twice");
      }
  }

  void read_outputs() {
    config_.keep = {"press", "render"};
    auto outputs = in_.optional_section("outputs");
    if (!outputs) return;
    config_.shard_bytes = 1e6 * outputs->number_or("shard_mb", 1000.0, Range::positive());
    config_.pack = outputs->choice_or("pack", config_.pack, {"full", "slim", "full_sim", "none"});
    if (outputs->has("keep")) config_.keep = outputs->texts("keep");
    for (const std::string& stage : config_.keep)
      if (stage != "press" && stage != "render") outputs->fault("keep", "'" + stage + "' is not one of press, render");
  }

  ConfigReader& in_;
  DatasetConfig& config_;
  fs::path folder_;
  std::set<std::string> gels_, objects_, motions_;
};

}  // namespace

bool EnsembleChoice::is_of(const SensorChoice& sensor) const {
  std::error_code error;
  return fs::equivalent(sensor.sensor, ensemble.sensor, error);
}

std::string EnsembleChoice::mesh_of(const SensorChoice& sensor) const {
  return mesh_config ? mesh_config->stem().string() : sensor.mesh;
}

std::string EnsembleChoice::gel_of(const SensorChoice& sensor, const std::string& press) const {
  const std::string gel = sensor.name + "-" + mesh_of(sensor);
  return press == kNominal ? gel : gel + "." + press;
}

std::string EnsembleChoice::sensor_file(const SensorChoice& sensor, const std::string& member) {
  return "ensemble/" + sensor.name + "/" + member + ".yaml";
}

DatasetEnsemble EnsembleChoice::planned(const std::vector<SensorChoice>& sensors) const {
  DatasetEnsemble planned{.title = ensemble.title, .mesh = mesh_config ? mesh_config->stem().string() : ""};
  for (const SensorChoice& sensor : sensors)
    if (is_of(sensor)) planned.sensor = sensor.name;
  for (const EnsembleMember& member : ensemble.members) planned.members.push_back(member.name);
  return planned;
}

DatasetConfig DatasetConfig::read(ConfigReader& in) {
  DatasetConfig config;
  Reader(in, config).read();
  return config;
}

}  // namespace tacipc
