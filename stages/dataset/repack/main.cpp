#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/sha256.h"
#include "common/sample/shard_list.h"
#include "common/stage/stage.h"
#include "stages/dataset/repack/frame_files.h"
#include "stages/dataset/repack/lerobot.h"
#include "stages/dataset/repack/tar_writer.h"
#include "stages/dataset/repack/univtac.h"

namespace {

using namespace tacipc;

const StageSpec kRepack{
    .name = "repack",
    .summary = "Turn packed shards into another layout: WebDataset tar, UniVTAC HDF5, plain folder, LeRobot dataset.",
    .inputs = {{.flag = "--config", .help = "which layout (YAML)"},
               {.flag = "--shard", .help = "HDF5 file of pack; for all layouts but lerobot", .required = false},
               {.flag = "--shards",
                .help = "for lerobot: text file with the record of each shard (pack.yaml), a line each",
                .required = false}}};

/// All shards of a dataset as one.
void repack_for_lerobot(Stage& stage) {
  if (stage.optional_input("--shard") || !stage.optional_input("--shards"))
    throw UsageError("lerobot takes --shards, the list of all shards, in place of --shard");
  const auto inputs = listed_shards(stage.input("--shards"));
  std::vector<std::filesystem::path> shards;
  for (const auto& [name, path] : inputs) {
    checked_sha256(path);
    shards.push_back(path);
  }
  stage.add_inputs(inputs);
  stage.summarize(write_lerobot(shards, [&](const std::string& name) { return stage.output(name); }));
}

struct RepackConfig {
  std::string format;

  static RepackConfig read(ConfigReader& in) {
    return {.format = in.choice("format", {"webdataset", "univtac", "folder", "lerobot"})};
  }
};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kRepack, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<RepackConfig>("--config");
    if (config.format == "lerobot") return repack_for_lerobot(stage);
    if (!stage.optional_input("--shard") || stage.optional_input("--shards"))
      throw UsageError("this layout takes --shard, one shard; only lerobot takes --shards");
    checked_sha256(stage.input("--shard"));  // HDF5 crashes on some damaged files, and reads others as if whole
    const Hdf5Reader shard(stage.input("--shard"));
    if (!shard.has("/data")) throw DataError("{}: is not a shard of pack", stage.input("--shard").string());
    const std::string name = shard.text_attribute("/", "shard");
    const std::vector<std::string> ids = shard.names("/data");
    std::optional<TarWriter> tar;
    if (config.format == "webdataset") tar.emplace(stage.output(name + ".tar"));
    std::size_t files = 0;
    for (const std::string& id : ids) {
      show_progress(static_cast<double>(&id - ids.data()) / static_cast<double>(ids.size()), id);
      if (config.format == "univtac") {
        write_univtac(shard, id, stage.output(id + ".hdf5"));
        ++files;
        continue;
      }
      write_frames(shard, id, [&](const std::string& file, std::string_view bytes) {
        ++files;
        if (tar)
          tar->add(file, bytes);
        else
          write_file(stage.output(file), bytes);
      });
    }
    if (tar) tar->close();
    if (config.format != "univtac") write_file(stage.output("fields.json"), fields_json(shard));
    log_info("{}: {} samples, {} files", name, ids.size(), files);
    stage.summarize({{"shard", name}, {"samples", ids.size()}, {"files", files}});
  });
}
