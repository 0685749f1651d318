#include <optional>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/sha256.h"
#include "common/sample/shard_list.h"
#include "common/stage/stage.h"
#include "stages/dataset/repack/frame_archives.h"
#include "stages/dataset/repack/lerobot.h"
#include "stages/dataset/repack/univtac.h"

namespace {

using namespace tacipc;

const StageSpec kRepack{
    .name = "repack",
    .summary = "Turn packed shards into another layout: WebDataset tar, UniVTAC HDF5, plain folder, LeRobot dataset.",
    .inputs = {{.flag = "--config", .help = "which layout (YAML)"},
               {.flag = "--shard", .help = "HDF5 file of pack; for webdataset and folder", .required = false},
               {.flag = "--shards",
                .help = "for lerobot and univtac: text file with the record of each shard (pack.yaml), a line each",
                .required = false}},
    .works_in_child = true};

/// Writes all shards of a dataset as episodes.
void repack_episodes(Stage& stage, const std::string& format) {
  if (stage.optional_input("--shard") || !stage.optional_input("--shards"))
    throw UsageError(fmt::format("{} takes --shards, the list of all shards, in place of --shard", format));
  const auto inputs = listed_shards(stage.input("--shards"));
  std::vector<std::filesystem::path> shards;
  for (const auto& [name, path] : inputs) {
    checked_sha256(path);
    shards.push_back(path);
  }
  stage.add_inputs(inputs);
  const OutputPath output = [&](const std::string& name) { return stage.output(name); };
  const Value::Map summary = format == "lerobot" ? write_lerobot(shards, output) : write_univtac(shards, output);
  for (const auto& [name, value] : summary)
    if (name == "fingers_left_out")
      log_warning("{} fingers of grasps are left out: the other finger of each is in no shard",
                  std::get<std::int64_t>(value.data()));
  stage.summarize(summary);
}

struct RepackConfig {
  std::string format;

  static RepackConfig read(ConfigReader& in) {
    return {.format = in.choice("format", {"webdataset", "univtac", "folder", "lerobot"})};
  }
};

/// Writes a shard as archives, or as a folder of files for each sample.
/// \return number of files
std::size_t repack_files(Stage& stage, const Hdf5Reader& shard, const std::string& name, bool archives) {
  const OutputPath output = [&](const std::string& file) { return stage.output(file); };
  std::optional<FrameArchives> tars;
  if (archives) tars.emplace(name, output);
  std::size_t files = 0;
  const std::vector<std::string> ids = shard.names("/data");
  for (const std::string& id : ids) {
    show_progress(static_cast<double>(&id - ids.data()) / static_cast<double>(ids.size()), id);
    const SampleFiles sample(shard, id);
    files += tars ? tars->add(sample) : write_folder(sample, output);
  }
  if (tars) tars->close();
  write_file(stage.output("fields.json"), fields_json(shard));
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kRepack, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<RepackConfig>("--config");
    if (config.format == "lerobot" || config.format == "univtac") return repack_episodes(stage, config.format);
    if (!stage.optional_input("--shard") || stage.optional_input("--shards"))
      throw UsageError("this layout takes --shard, one shard; only lerobot and univtac take --shards");
    checked_sha256(stage.input("--shard"));  // HDF5 crashes on some damaged files and misreads others
    const Hdf5Reader shard(stage.input("--shard"));
    if (!shard.has("/data")) throw DataError("{}: is not a shard of pack", stage.input("--shard").string());
    const std::string name = shard.name_attribute("/", "shard");
    const std::size_t samples = shard.names("/data").size();
    const std::size_t files = repack_files(stage, shard, name, config.format == "webdataset");
    log_info("{}: {} samples, {} files", name, samples, files);
    stage.summarize({{"shard", name}, {"samples", samples}, {"files", files}});
  });
}
