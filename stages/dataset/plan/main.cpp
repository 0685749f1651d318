#include <array>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/sample/rendered_frames.h"
#include "common/stage/stage.h"
#include "stages/dataset/plan/plan_checks.h"
#include "stages/dataset/plan/plan_files.h"

namespace {

using namespace tacipc;

const StageSpec kPlan{
    .name = "plan",
    .summary =
        "Draw the samples of a dataset from its one file: poses, seeds, splits, and rules for make. --out is the "
        "folder plan of the dataset.",
    .inputs = {{.flag = "--config", .help = "the dataset (YAML)"}},
    .keeps_old_until_done = true};

std::vector<Sensor> read_sensors(Stage& stage, const DatasetConfig& config) {
  std::vector<Sensor> sensors;
  for (const SensorChoice& choice : config.sensors) {
    stage.add_input("sensor_" + choice.gel(), choice.sensor);
    sensors.push_back(read_config<Sensor>(choice.sensor));
  }
  return sensors;
}

/// Expected size of a sample in a shard, by sensor and motion.
std::vector<std::vector<double>> packed_bytes(Stage& stage, const DatasetConfig& config,
                                              const std::vector<Sensor>& sensors) {
  stage.add_input("render", config.render);
  const RenderedFrames frames = read_rendered_frames(config.render);
  std::vector<std::vector<double>> bytes;
  for (const Sensor& sensor : sensors) {
    bytes.emplace_back();
    for (const MotionChoice& motion : config.motions) {
      std::vector<std::string> kinds;
      for (const PhaseTemplate& phase : motion.motion.phases) kinds.push_back(phase.kind);
      bytes.back().push_back(kPackedBytesPerPixel * sensor.camera.width_px * sensor.camera.height_px *
                             count_rendered(frames, motion.motion.frames(), kinds));
    }
  }
  return bytes;
}

/// Text with every key and its value, including defaults.
std::string resolved_text(const std::filesystem::path& file) {
  ConfigReader in = ConfigReader::from_file(file);
  DatasetConfig::read(in);
  return to_yaml(in.resolved());
}

std::array<int, 3> count(const std::vector<PlannedSample>& samples, Split PlannedSample::*split) {
  std::array<int, 3> counts{};
  for (const PlannedSample& sample : samples) ++counts[static_cast<std::size_t>(sample.*split)];
  return counts;
}

Value::Map split_lines(const std::array<int, 3>& counts) {
  return {{"train", counts[0]}, {"val", counts[1]}, {"test", counts[2]}};
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kPlan, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<DatasetConfig>("--config");
    const std::vector<Sensor> sensors = read_sensors(stage, config);
    auto faults = faults_of_plan(config, sensors, stage.input("--config").string());
    if (!faults.empty()) throw ConfigError(std::move(faults));
    const auto samples = plan_samples(config, packed_bytes(stage, config, sensors));
    const std::vector<Choice> choices = choices_of(config, sensors);
    for (const auto& [name, content] : plan_files(config, choices, samples)) write_file(stage.output(name), content);
    write_file(stage.output("dataset.yaml"), resolved_text(stage.input("--config")));

    const auto by_object = count(samples, &PlannedSample::split);
    const auto& splits = config.splits;
    for (const auto& [split, share] : {std::pair{Split::val, splits.val}, {Split::test, splits.test}})
      if (share > 0.0 && by_object[static_cast<std::size_t>(split)] == 0)
        log_warning("{} objects are too few for one in {}", config.objects.size(), name_of(split));
    stage.summarize({{"samples", samples.size()},
                     {"sensors", config.sensors.size()},
                     {"objects", config.objects.size()},
                     {"motions", config.motions.size()},
                     {"split_by_object", split_lines(by_object)},
                     {"split_by_pose", split_lines(count(samples, &PlannedSample::split_pose))}});
    stage.retire_old_record();  // the samples' files are not outputs, and from here on they belong to another plan
    const int written = write_dataset_files(config, choices, samples, stage.out().parent_path());
    log_info("{} samples of {} objects, {} motions, {} sensors; {} new or changed", samples.size(),
             config.objects.size(), config.motions.size(), config.sensors.size(), written);
  });
}
