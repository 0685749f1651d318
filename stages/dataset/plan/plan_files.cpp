#include "stages/dataset/plan/plan_files.h"

#include <fmt/core.h>

#include <map>
#include <set>

#include "common/base/checked_file.h"
#include "common/base/files.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMapsFile = "maps.yaml";

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text.append(" ").append(word);
  return text;
}

/// Part of the path after `samples/`.
std::string place_of(const std::string& folder) { return folder.substr(8); }

/// Files that render reads for a gel, without its settings.
std::string files_of_render(const std::vector<Choice>& choices, const SensorChoice& sensor) {
  std::vector<std::string> files;
  for (const Choice& choice : choices)
    if (choice.name == "render-" + sensor.gel())
      for (auto chosen = choice.files.begin() + 1; chosen != choice.files.end(); ++chosen)
        files.push_back(chosen->file.generic_string());
  return joined(files);
}

/// Gels of the members, and for each gel of samples the additional presses, each with its gel.
std::string ensemble_mk(const DatasetConfig& config, const EnsembleChoice& choice) {
  std::string text;
  std::set<std::string> known;
  for (const SensorChoice& sensor : config.sensors) known.insert(sensor.gel());
  const DatasetEnsemble planned = choice.planned(config.sensors);
  for (const SensorChoice& sensor : config.sensors) {
    if (!choice.is_of(sensor)) continue;
    std::string presses;
    for (const std::string& press : planned.presses()) {
      const std::string gel = choice.gel_of(sensor, press);
      presses += fmt::format(" {}:{}", press, gel);
      if (!known.insert(gel).second) continue;
      const std::string file = press == kNominal ? sensor.sensor.generic_string()
                                                 : "$(DATASET_DIR)/" + EnsembleChoice::sensor_file(sensor, press);
      text += fmt::format("$(eval $(call dataset_gel,{},{},{},{},))\n", gel, file,
                          choice.mesh_config.value_or(sensor.mesh_config).generic_string(),
                          !choice.mesh_config && sensor.import ? sensor.import->generic_string() : "");
    }
    text += fmt::format("DATASET_ENSEMBLE_{} :={}\n", sensor.gel(), presses);
  }
  return text + "DATASET_ENSEMBLE := yes\n";
}

std::string dataset_mk(const DatasetConfig& config, const std::vector<Choice>& choices,
                       const std::vector<std::string>& blocks, const std::vector<std::string>& shards,
                       std::size_t samples) {
  std::string text = "# Made by the stage plan.\n";
  const auto set = [&](const std::string& name, const std::string& value) {
    text += fmt::format("DATASET_{} := {}\n", name, value);
  };
  set("CHOICES", "$(DATASET_DIR)/choices");
  set("SAMPLES", std::to_string(samples));
  set("BLOCKS", joined(blocks));
  set("RENDER", config.render.generic_string());
  set("MAPS", fmt::format("$(DATASET_DIR)/{}", kMapsFile));
  set("DECIMATE", config.decimate.generic_string());
  set("PROFILE", config.pack);
  set("KEEP", joined(config.keep));
  set("SHARDS", joined(shards));
  text += fmt::format("DATASET_STOP_AFTER ?= {}\n", config.stop_after_failures);
  for (const SensorChoice& choice : config.sensors)
    text += fmt::format("$(eval $(call dataset_gel,{},{},{},{},{}))\n", choice.gel(), choice.sensor.generic_string(),
                        choice.mesh_config.generic_string(), choice.import ? choice.import->generic_string() : "",
                        files_of_render(choices, choice));
  if (config.ensemble) text += ensemble_mk(config, *config.ensemble);
  for (const ObjectChoice& object : config.objects)
    text += fmt::format("$(eval $(call dataset_{},{},{}))\n",
                        object.embossed    ? "embossed"
                        : object.spec.wrap ? "wrapped"
                                           : "mesh",
                        object.name, object.file.generic_string());
  return text;
}

/// Prerequisites of the plan: files and folders.
std::set<fs::path> inputs_of(const DatasetConfig& config, const std::vector<Choice>& choices) {
  std::set<fs::path> paths(config.named.begin(), config.named.end());
  for (const Choice& choice : choices)
    for (const ChosenFile& chosen : choice.files) paths.insert(chosen.file);
  return paths;
}

std::string inputs_txt(const std::set<fs::path>& inputs) {
  std::string text;
  for (const fs::path& path : inputs) text += path.generic_string() + "\n";
  return text;
}

/// Missing files are left to the plan, whose message is clearer than make's.
std::string inputs_mk(const std::set<fs::path>& inputs) {
  std::string text = "$(DATASET_DIR)/plan/plan.yaml:", rules;
  for (const fs::path& path : inputs) {
    text.append(" ").append(path.generic_string());
    rules += path.generic_string() + ":\n";
  }
  return "# Made by the stage plan.\n" + text + "\n" + rules;
}

/// Path files of a motion.
std::string paths_of(const MotionChoice& motion) {
  std::string text;
  for (const PhaseTemplate& phase : motion.motion.phases)
    if (!phase.path_file.empty()) text.append(" ").append(phase.path_file.generic_string());
  return text;
}

/// Seeds of the renders of a sample, or of both fingers of its grasp.
std::string seeds_of(const std::vector<PlannedSample>& samples, const PlannedSample& sample) {
  if (!sample.finger) return std::to_string(sample.seed);
  const auto left = static_cast<std::size_t>(sample.index - *sample.finger);
  return fmt::format("{} {}", samples[left].seed, samples[left + 1].seed);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> plan_files(const DatasetConfig& config,
                                                            const std::vector<Choice>& choices,
                                                            const std::vector<PlannedSample>& samples) {
  std::vector<std::pair<std::string, std::string>> files{{"samples.csv", samples_csv(config, samples)}};
  std::map<std::string, std::string> rules, members;
  std::vector<std::string> blocks;
  std::set<std::string> shards;
  for (const PlannedSample& sample : samples) {
    const std::string block = fmt::format("{:03}", sample.index / kSamplesOfAFolder);
    if (blocks.empty() || blocks.back() != block) blocks.push_back(block);
    const MotionChoice& motion = config.motions[static_cast<std::size_t>(sample.motion)];
    // One rule makes both fingers of a grasp; make may be given the block of the right one alone.
    if (sample.finger.value_or(0) == 0 || rules[block].empty())
      rules[block] +=
          fmt::format("$(eval $(call dataset_{},{},{},{},{},{},{},{}))\n", sample.finger ? "grasp" : "sample",
                      place_of(sample.press_folder()), config.objects[static_cast<std::size_t>(sample.object)].name,
                      config.sensors[static_cast<std::size_t>(sample.sensor)].gel(), motion.press.generic_string(),
                      paths_of(motion), seeds_of(samples, sample), motion.name);
    shards.insert(sample.shard);
    members[block].append(" ").append(place_of(sample.folder()));
  }
  for (const std::string& block : blocks)
    files.emplace_back("blocks/" + block + ".mk",
                       rules[block] + "DATASET_BLOCK_" + block + " :=" + members[block] + "\n");
  files.emplace_back("dataset.mk", dataset_mk(config, choices, blocks, {shards.begin(), shards.end()}, samples.size()));
  const std::set<fs::path> inputs = inputs_of(config, choices);
  files.emplace_back("inputs.mk", inputs_mk(inputs));
  files.emplace_back("inputs.txt", inputs_txt(inputs));
  for (std::size_t m = 0; m < config.motions.size(); ++m) {
    const auto& phases = config.motions[m].motion.phases;
    for (std::size_t p = 0; p < phases.size(); ++p)
      if (!phases[p].path_file.empty())
        files.emplace_back(path_name(config, static_cast<int>(m), static_cast<int>(p)), read_file(phases[p].path_file));
  }
  return files;
}

int write_dataset_files(const DatasetConfig& config, const std::vector<Choice>& choices,
                        const std::vector<PlannedSample>& samples, const fs::path& dataset) {
  if (config.ensemble) {
    for (const SensorChoice& sensor : config.sensors) {
      if (!config.ensemble->is_of(sensor)) continue;
      for (const EnsembleMember& member : config.ensemble->ensemble.members)
        replace_if_changed(dataset / EnsembleChoice::sensor_file(sensor, member.name),
                           sensor_of(config.ensemble->ensemble, member));
    }
    replace_if_changed(dataset / kEnsembleFile, config.ensemble->planned(config.sensors).yaml());
  } else {
    fs::remove(dataset / kEnsembleFile);
  }
  write_choices(choices, dataset / "choices");
  replace_if_changed(dataset / kMapsFile, config.maps.yaml());
  for (const ObjectChoice& object : config.objects)
    replace_if_changed(dataset / "objects" / object.name / "object.yaml", object.spec.yaml());
  int written = 0;
  for (const PlannedSample& sample : samples)
    if (sample.finger.value_or(0) == 0)
      written += replace_if_changed(dataset / sample.press_folder() / "sample.yaml", sample_yaml(config, sample));
  return written;
}

}  // namespace tacipc
