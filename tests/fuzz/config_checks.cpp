#include <cmath>
#include <stdexcept>
#include <vector>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/config/config.h"
#include "common/config/config_text.h"
#include "common/config/key_path.h"
#include "common/sample/dataset_maps.h"
#include "common/sample/object.h"
#include "common/sample/sample_spec.h"
#include "common/sensor/sensor.h"
#include "common/stage/record.h"
#include "common/stage/stage_timings.h"
#include "tests/fuzz/fuzzed_readers.h"
#include "tests/fuzz/reader_checks.h"

namespace tacipc {
namespace {

constexpr std::size_t kMostPaths = 1000;  // of one file

void require(bool holds, const std::string& what) {
  if (!holds) throw std::logic_error(what);
}

Value content_of(const std::string& text, const std::string& name) {
  ConfigReader in = ConfigReader::from_text(text, name);
  for (const std::string& key : in.keys()) in.ignore(key);
  in.finish();
  return in.content();
}

/// Each key in the way that `way` says, sections below it in the next one.
void read_keys(ConfigReader& in, int way) {
  for (const std::string& key : in.keys()) {
    require(in.has(key), "a key that is not there");
    switch (way++ % 9) {
      case 0: in.number(key, Range::positive()); break;
      case 1: in.integer_or(key, 3, -5, 7); break;
      case 2: in.flag(key); break;
      case 3: in.choice(key, {"press", "shear", "+x"}); break;
      case 4: in.numbers(key, 3, Range::between(-1, 1)); break;
      case 5: in.choices_or(key, {}, {"depth", "normal", "contact"}); break;
      case 6: in.texts(key); break;
      case 7:
        if (auto section = in.optional_section(key)) read_keys(*section, way);
        break;
      default:
        for (ConfigReader& section : in.one_or_more_sections(key)) read_keys(section, way);
    }
  }
}

/// Every way in which a record's values are asked for. Values of other types are refused one by one.
void read_keys(const Record& record) {
  const auto may_refuse = [](const auto& read) {
    try {
      read();
    } catch (const DataError&) {
      // Said of this key; the others are asked for all the same.
    }
  };
  for (const std::string& key : record.keys()) {
    require(record.has(key), "a key that is not there");
    may_refuse([&] { record.text(key); });
    may_refuse([&] { record.number(key); });
    may_refuse([&] { require(record.count(key).value_or(0) >= 0, "a negative count"); });
    may_refuse([&] { record.flag(key); });
    may_refuse([&] { record.texts(key); });
    may_refuse([&] { record.numbers(key, 3); });
    may_refuse([&] { record.range(key); });
    may_refuse([&] {
      for (const Record& section : record.one_or_many(key)) read_keys(section);
    });
  }
}

/// Paths of what a value holds, to the leaves; at most kMostPaths.
void collect_paths(const Value& value, std::vector<KeyStep>& steps, std::vector<std::string>& paths) {
  if (paths.size() >= kMostPaths) return;
  const auto visit = [&](KeyStep step, const Value& below) {
    steps.push_back(std::move(step));
    paths.push_back(to_text(steps));
    collect_paths(below, steps, paths);
    steps.pop_back();
  };
  if (const auto* map = std::get_if<Value::Map>(&value.data()))
    for (const auto& [key, below] : *map) visit(key, below);
  if (const auto* list = std::get_if<Value::List>(&value.data()))
    for (std::size_t i = 0; i < list->size(); ++i) visit(i, (*list)[i]);
}

}  // namespace

void check_yaml(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  const Value content = content_of(text, file.string());
  const std::string written = to_yaml(content);
  require(to_yaml(content_of(written, "written")) == written, "written out it says something else: " + written);
  for (int way = 0; way < 9; ++way) {
    ConfigReader in = ConfigReader::from_file(file);
    in.accept_sources();
    read_keys(in, way);
    in.sources();
    to_yaml(in.resolved());
    try {
      in.finish();
    } catch (const ConfigError& error) {
      check_refusal(error, file);  // of its values; the file itself is YAML
    }
  }
}

void check_edits(const std::filesystem::path& file) {
  const ConfigText config(read_file(file), file.string());
  const Value content = content_of(config.text(), file.string());
  std::vector<std::string> paths;
  std::vector<KeyStep> steps;
  collect_paths(content, steps, paths);
  const auto edit = [&](const auto& change) {
    ConfigText copy = config;
    try {
      change(copy);
      content_of(copy.text(), file.string());
    } catch (const ConfigError& error) {
      check_refusal(error, file);
    }
  };
  if (!paths.empty()) {
    // One place, which changes with every byte more or less: edits take long.
    const std::string& path = paths[config.text().size() % paths.size()];
    edit([&](ConfigText& copy) { copy.set(path, "{a: [1, 'b']}"); });
    edit([&](ConfigText& copy) { copy.remove(path); });
    edit([&](ConfigText& copy) { copy.add(path + ".new.key", "0.5"); });
  }
  edit([&](ConfigText& copy) { copy.add("new_key", "0.5"); });
}

void check_sensor(const std::filesystem::path& file) {
  const auto sensor = read_config<Sensor>(file);
  for (const Led& led : sensor.leds) {
    require(led.position_m.allFinite(), "an LED at no place");
    require(std::abs(led.normal.norm() - 1.0) < 1e-9, "an LED that looks nowhere");
  }
  require(sensor.camera.position_m.allFinite() && sensor.camera.rotation_rad.allFinite(), "a camera at no place");
  if (sensor.light_field) require(sensor.light_field->weights.allFinite(), "light that is not finite");
}

void check_motion(const std::filesystem::path& file) {
  SampleSpec spec;
  try {
    spec = read_config<SampleSpec>(file);
  } catch (const DataError& error) {
    if (std::string(error.what()).starts_with(file.string())) throw;
    return;  // it names a path's file, which is not there
  }
  require(std::isfinite(spec.rotate_rad), "a turn that is not finite");
  for (const Phase& phase : spec.motion) {
    require(time_steps(phase) >= 0, "a phase that ends before it begins");
    const Goal goal = goal_of(
        phase, 0.5,
        PhaseStart{
            .gel_from_object = Matrix4::Identity(), .placed = Matrix4::Identity(), .reference_m = Vector3::Zero()},
        1e-2);
    require(goal.gel_from_object.allFinite() && goal.load_n.allFinite(), "a goal that is not finite");
  }
}

void check_object(const std::filesystem::path& file) {
  ConfigReader in = ConfigReader::from_file(file);
  ObjectSpec::read(in);
  DatasetMaps::read(in);
  in.finish();
}

void check_record(const std::filesystem::path& file) {
  read_keys(Record::from_file(file));
  read_timings(file);
}

}  // namespace tacipc
