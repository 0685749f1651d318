#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/json.h"
#include "common/base/log.h"
#include "common/base/sha256.h"
#include "common/sample/shard_list.h"
#include "common/sensor/camera_description.h"
#include "common/stage/stage.h"
#include "stages/dataset/card/readme.h"

namespace {

using namespace tacipc;
namespace fs = std::filesystem;

const StageSpec kCard{
    .name = "card",
    .summary = "Put packed shards together into the dataset that users download: tables, splits, card, checksums.",
    .inputs = {{.flag = "--config", .help = "purpose, licence (YAML)"},
               {.flag = "--plan", .help = "samples.csv of plan"},
               {.flag = "--dataset", .help = "dataset.yaml of plan"},
               {.flag = "--shards",
                .help = "text file with the record of each shard (pack.yaml), a line each, as seen from the file"},
               {.flag = "--loader", .help = "Python lines that load a shard"},
               {.flag = "--check-labels", .help = "Python program that recomputes the labels of grasps"},
               {.flag = "--citation", .help = "CITATION.cff", .required = false}},
    .options = {{.flag = "--name", .help = "the dataset's name", .fallback = "dataset"}},
    .keeps_old_until_done = true};

/// Names of the outputs whose digests are published.
class Checksums {
 public:
  explicit Checksums(Stage& stage) : stage_(stage) {}

  /// Like Stage::output; the digest is computed when everything is written.
  fs::path output(const std::string& name) {
    files_.emplace_back(name, stage_.output(name));
    return files_.back().second;
  }
  void known(const std::string& name, const std::string& digest) { lines_.push_back({name, digest}); }

  std::string text() {
    for (const auto& [name, path] : files_) lines_.push_back({name, sha256_of_file(path)});
    std::sort(lines_.begin(), lines_.end());
    std::string text;
    for (const auto& [name, digest] : lines_) text += fmt::format("{}  {}\n", digest, name);
    return text;
  }

 private:
  Stage& stage_;
  std::vector<std::pair<std::string, fs::path>> files_;
  std::vector<std::pair<std::string, std::string>> lines_;
};

/// Copies the files instead of linking them, because a user may edit a sensor file in place.
void copy_origins(Stage& stage, Checksums& sums, const std::string& folder,
                  const std::map<std::string, std::map<std::string, OriginFile>>& origins) {
  std::vector<std::pair<std::string, fs::path>> inputs;
  for (const auto& [id, files] : origins) {
    for (const auto& [role, file] : files) {
      if (!fs::exists(file.path) || content_hash(file.path) != file.hash)
        throw DataError("{}: has changed or been removed since the samples were made from it", file.path.string());
      inputs.emplace_back(fmt::format("{}/{}/{}", folder, id, role), file.path);
      write_file(sums.output(fmt::format("{}/{}/{}{}", folder, id, role, file.path.extension().string())),
                 read_file(file.path));
    }
  }
  stage.add_inputs(inputs);
}

/// Checks the shards.
/// \throw DataError if one differs from the packed bytes
void check_shards(const std::vector<PackedShard>& shards) {
  for (const PackedShard& shard : shards) {
    show_progress(static_cast<double>(&shard - shards.data()) / static_cast<double>(shards.size()), shard.name);
    const fs::path file = shard.folder / (shard.name + ".h5");
    if (checked_sha256(file) != shard.sha256)
      throw DataError("{}: is not the file that pack.yaml beside it describes (pack the shard again)", file.string());
  }
}

void write_cameras(Checksums& sums, const ShardRecords& records) {
  for (const auto& [id, files] : records.sensors) {
    const auto sensor = read_config<Sensor>(files.at("sensor").path);
    write_file(sums.output(fmt::format("sensors/{}/camera.json", id)), to_json(describe_camera(sensor)));
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kCard, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<CardConfig>("--config");
    const std::vector<fs::path> listed = listed_records(stage.input("--shards"));
    stage.add_inputs(named_by_shard(listed));
    const ShardRecords records = read_shard_records(listed);
    check_shards(records.shards);
    Checksums sums(stage);
    const DatasetCounts counts = join_tables(stage.input("--plan"), records, [&](const std::string& name) {
      return name == "timings.csv" ? stage.varying_output(name) : sums.output(name);
    });
    write_file(sums.output("dataset.yaml"), read_file(stage.input("--dataset")));
    const std::string schema = read_file(records.shards.front().folder / "schema.json");
    const fs::path schema_path = sums.output("schema.json");
    write_file(schema_path, schema);
    copy_origins(stage, sums, "sensors", records.sensors);
    copy_origins(stage, sums, "objects", records.objects);
    write_cameras(sums, records);
    std::string citation;
    if (const auto path = stage.optional_input("--citation")) {
      citation = read_file(*path);
      write_file(sums.output("CITATION.cff"), citation);
    }
    if (!counts.outcomes.empty()) write_file(sums.output("check_labels.py"), read_file(stage.input("--check-labels")));
    const Record fields = Record::from_file(schema_path);
    write_file(sums.output("README.md"), dataset_card({.name = stage.option("--name"),
                                                       .config = config,
                                                       .shards = records,
                                                       .counts = counts,
                                                       .schema = fields,
                                                       .loader = read_file(stage.input("--loader")),
                                                       .citation = citation}));
    for (const PackedShard& shard : records.shards) {
      const std::string name = shard.name + ".h5";
      stage.link_output("shards/" + name, shard.folder / name, shard.file_hash);
      write_file(sums.output("shards/" + name + ".sha256"), fmt::format("{}  {}\n", shard.sha256, name));
      sums.known("shards/" + name, shard.sha256);
    }
    write_file(stage.output("checksums.sha256"), sums.text());
    int samples = 0;
    for (const PackedShard& shard : records.shards) samples += shard.samples;
    const auto clipped = counts.extents.find("clipped_fraction");
    stage.summarize({{"shards", records.shards.size()},
                     {"samples", samples},
                     {"max_clipped_fraction", clipped == counts.extents.end() ? 0.0 : clipped->second.high}});
    log_info("{} shards, {} samples", records.shards.size(), samples);
  });
}
