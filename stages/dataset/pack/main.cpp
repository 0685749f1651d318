#include <fmt/core.h>
#include <malloc.h>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/json.h"
#include "common/base/log.h"
#include "common/base/sha256.h"
#include "common/format/csv.h"
#include "common/sample/ensemble.h"
#include "common/sample/sample_status.h"
#include "common/sensor/camera_description.h"
#include "common/stage/stage.h"
#include "stages/dataset/pack/manifest.h"
#include "stages/dataset/pack/origins.h"
#include "stages/dataset/pack/shard_writer.h"

namespace {

using namespace tacipc;
namespace fs = std::filesystem;

const StageSpec kPack{
    .name = "pack",
    .summary = "Pack the made samples of one shard into an HDF5 file that loaders read.",
    .inputs = {{.flag = "--config", .help = "which fields (YAML)"},
               {.flag = "--plan", .help = "samples.csv of plan; its samples lie beside the folder it is in"},
               {.flag = "--dataset",
                .help = "the part of dataset.yaml that all samples share; the shard holds its hash",
                .required = false}},
    .options = {{.flag = "--shard", .help = "which shard of the plan", .fallback = ""}},
    .keeps_old_until_done = true};

struct ShardSample {
  PlannedRow plan;
  fs::path folder;
  std::optional<Failure> failure;
};

/// Ensemble of the dataset, if it has one.
std::optional<DatasetEnsemble> ensemble_of(Stage& stage) {
  const fs::path dataset = fs::absolute(stage.input("--plan")).parent_path().parent_path();
  auto ensemble = ensemble_of_dataset(dataset);
  if (ensemble) stage.add_input("ensemble", dataset / kEnsembleFile);
  return ensemble;
}

/// Finds the shard's part of the plan and its existing samples, whose records become inputs.
/// \param presses presses of the ensemble for each sample
std::vector<ShardSample> find_samples(Stage& stage, const PackConfig& config, const std::vector<std::string>& presses) {
  const fs::path plan = stage.input("--plan");
  const fs::path dataset = fs::absolute(plan).parent_path().parent_path();
  std::vector<ShardSample> samples;
  std::vector<std::pair<std::string, fs::path>> records;
  for_each_planned(plan, stage.option("--shard"), [&](const PlannedRow& planned) {
    ShardSample sample{planned, dataset / planned.folder, failure_of(dataset / planned.folder)};
    if (sample.failure && sample.failure->made_nothing && !config.list_unmade)
      throw DataError(
          "{}: {} has neither a record nor a failure: make the samples first (or set unmade: list in the "
          "configuration)",
          sample.folder.string(), sample.failure->stage);
    for (const std::string& press : presses) {
      for (const char* record : {"press.yaml", "press.failed.yaml"})
        if (const fs::path path = member_press(sample.folder, press) / record; fs::exists(path))
          records.emplace_back(planned.id + "/ensemble/" + press + "/" + record, path);
    }
    for (const std::string part : {"press", "render"}) {
      for (const auto& [ending, path] : {std::pair{".yaml", sample.folder / part / (part + ".yaml")},
                                         {".failed.yaml", stage_file(sample.folder, part, ".failed.yaml")}})
        if (fs::exists(path)) records.emplace_back(planned.id + "/" + part + ending, path);
    }
    samples.push_back(std::move(sample));
  });
  stage.add_inputs(records);
  return samples;
}

}  // namespace

int main(int argc, char** argv) {
  // Images of every frame are allocated and freed. If they returned to the kernel each time, it would clear them for
  // each allocation: a tenth of the time.
  constexpr int kKept = 64 << 20;
  mallopt(M_MMAP_THRESHOLD, kKept);
  mallopt(M_TRIM_THRESHOLD, kKept);
  return run_stage(kPack, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<PackConfig>("--config");
    const std::string& shard = stage.option("--shard");
    if (shard.empty() || shard.find('/') != std::string::npos || shard.front() == '.')
      throw UsageError("--shard is required, for instance train-00000-of-00001");
    const auto ensemble = ensemble_of(stage);
    const std::vector<ShardSample> samples =
        find_samples(stage, config, ensemble ? ensemble->presses() : std::vector<std::string>());
    const std::string schema_text = to_json(config.schema(ensemble.has_value()));
    Value::Map root{{"format", "tactile-shard"},
                    {"version", 1},
                    {"shard", shard},
                    {"code_version", program_version()},
                    {"schema_sha256", sha256(schema_text)},
                    {"quat_order", "xyzw"}};
    if (const auto dataset = stage.optional_input("--dataset"))
      root.emplace_back("config_sha256", sha256_of_file(*dataset));
    else
      root.emplace_back("absent_config_sha256", "no dataset.yaml was given");

    const std::string name = shard + ".h5";
    const fs::path path = stage.output(name);
    ShardWriter writer(path, config, root);
    Origins origins;
    std::size_t presses_made = 0, presses_missing = 0;
    std::string manifest = csv_line(manifest_columns()), failures = csv_line(failure_columns()),
                timings = csv_line(timing_columns());
    for (const ShardSample& at : samples) {
      show_progress(static_cast<double>(&at - samples.data()) / static_cast<double>(samples.size()), at.plan.id);
      timings += csv_line(timing_row(at.plan.id, at.folder));
      if (at.failure) {
        manifest += csv_line(manifest_row(at.plan, *at.failure));
        failures += csv_line(failure_row(at.plan, *at.failure));
        continue;
      }
      SampleFrames sample(at.folder);
      if (ensemble && at.plan.sensor == ensemble->sensor && !sample.grasp()) {
        sample.add_ensemble(*ensemble);
        presses_made += sample.ensemble().made().size();
        presses_missing += sample.ensemble().missing().size();
      }
      const std::string sensor_id = sensor_id_of(at.plan, sample);
      origins.add(at.plan, sensor_id, sample);
      manifest += csv_line(manifest_row(at.plan, sensor_id, writer.samples(), sample));
      writer.add_sensor(sensor_id, describe_camera(sample.sensor()));
      writer.add_sample(at.plan, sensor_id, sample);
    }
    writer.close();
    for (const auto& [copy, file] : origins.copies()) write_file(stage.output(copy), read_file(file));

    const std::string digest = sha256_of_file(path);
    write_file(stage.output(name + ".sha256"), fmt::format("{}  {}\n", digest, name));
    write_file(stage.output("schema.json"), schema_text);
    write_file(stage.output("manifest.csv"), manifest);
    write_file(stage.output("failures.csv"), failures);
    write_file(stage.varying_output("timings.csv"), timings);
    log_info("{}: {} samples, {} frames, {} not made", shard, writer.samples(), writer.frames(),
             samples.size() - writer.samples());
    Value::Map summary{{"samples", writer.samples()},
                       {"not_made", samples.size() - writer.samples()},
                       {"frames", writer.frames()},
                       {"bytes", static_cast<std::size_t>(fs::file_size(path))},
                       {"sha256", digest}};
    if (ensemble) {
      summary.emplace_back("ensemble", Value::Map{{"title", ensemble->title},
                                                  {"members_pressed", presses_made},
                                                  {"presses_missing", presses_missing}});
      if (presses_missing > 0)
        log_warning("{}: {} presses of the ensemble are not there; fewer members make the deviations of their samples",
                    shard, presses_missing);
    }
    for (auto& line : origins.lines(stage.out())) summary.push_back(line);
    stage.summarize(summary);
  });
}
