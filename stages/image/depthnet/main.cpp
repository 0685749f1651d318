#include <algorithm>

#include "common/base/blas.h"
#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/format/csv.h"
#include "common/sample/shard_list.h"
#include "common/stage/stage.h"
#include "stages/image/depthnet/judge.h"
#include "stages/image/depthnet/outcome_config.h"
#include "stages/image/depthnet/outcome_report.h"
#include "stages/image/depthnet/train.h"
#include "stages/image/depthnet/training_look.h"

namespace {

using namespace tacipc;
namespace fs = std::filesystem;

const StageSpec kDepthnet{
    .name = "depthnet",
    .summary =
        "Train a network that reads depth from tactile images (--config), judge it on a dataset (--model); or train "
        "and judge networks that foretell outcomes of grasps (--config with task: outcome).",
    .inputs = {{.flag = "--config", .help = "network and training (YAML)", .required = false},
               {.flag = "--model",
                .help = "model_<width>x<height>.onnx of a training: several of one network where images have several "
                        "sizes",
                .required = false,
                .many = true},
               {.flag = "--shards",
                .help = "a packed dataset: text file with the record of each shard (shards.txt). Training takes the "
                        "splits train and val, judging the split test; outcomes of grasps take all",
                .required = false},
               {.flag = "--renders", .help = "folders of render to train on", .required = false, .many = true},
               {.flag = "--validation",
                .help = "folders of render to judge by while training",
                .required = false,
                .many = true}},
    .resumable = true};

void write_history(Stage& stage, const std::vector<LearntEpoch>& rows) {
  std::vector<std::string> names{"epoch", "learning_rate", "loss"};
  names.insert(names.end(), kJudgedErrors.begin(), kJudgedErrors.end());
  std::string text = csv_line(names);
  for (const LearntEpoch& row : rows) text += csv_line(history_fields(rows, row));
  write_file(stage.output("history.csv"), text);
}

/// Images of one split, and their sizes.
class Items {
 public:
  Items(const torch::jit::Module& network, int reduction) : network_(network), reduction_(reduction) {}
  void add(const DepthImage& image) {
    DepthItem item = item_of(image, network_, reduction_);
    if (!items_.empty() && items_.back().reference.equal(item.reference)) item.reference = items_.back().reference;
    items_.push_back(std::move(item));
    const ImageSize size(image.image.height, image.image.width);
    if (std::ranges::find(sizes_, size) == sizes_.end()) sizes_.push_back(size);
    show_progress(0.0, fmt::format("reading: {} images", items_.size()));
  }
  std::vector<DepthItem>& items() { return items_; }
  const std::vector<ImageSize>& sizes() const { return sizes_; }

 private:
  const torch::jit::Module& network_;
  int reduction_;
  std::vector<DepthItem> items_;
  std::vector<ImageSize> sizes_;
};

/// Shards of a list. They enter the record, which must show the training data.
std::vector<std::pair<std::string, fs::path>> shards_of(Stage& stage) {
  auto shards = listed_shards(stage.input("--shards"));
  stage.add_inputs(shards);
  return shards;
}

/// Checkpoints of the training of a name.
Checkpoints checkpoints_of(Stage& stage, const std::string& name) {
  return {.load = [&stage, name] { return stage.load_scratch(name); },
          .save = [&stage, name](const std::string& bytes) { stage.save_scratch(name, bytes); }};
}

/// Logs warnings and adds lines to the summary for images that differ from those of the training.
void warn_of_unlike(const LookReport& report, const char* what, Value::Map& summary) {
  for (const std::string& warning : report.warnings(what)) log_warning("{}", warning);
  if (report.images() > 0) summary.emplace_back("unlike_training", report.summary());
}

void train_depth(Stage& stage, const DepthnetConfig& config) {
  TrainedNetwork network{.file = "the network", .module = make_network(config.network, config.seed), .sizes = {}};
  Items training(network.module, config.network.reduction), validation(network.module, config.network.reduction);
  if (stage.optional_input("--shards"))
    for (const auto& [name, shard] : shards_of(stage))
      read_packed(shard, {"train", "val"}, config.last_frame,
                  [&](const DepthImage& image) { (image.split == "val" ? validation : training).add(image); });
  for (const fs::path& folder : stage.inputs("--renders"))
    read_rendered(folder, config.last_frame, [&](const DepthImage& image) { training.add(image); });
  for (const fs::path& folder : stage.inputs("--validation"))
    read_rendered(folder, config.last_frame, [&](const DepthImage& image) { validation.add(image); });
  if (training.items().empty()) throw DataError("there are no images to train on");
  network.sizes = training.sizes();
  for (const ImageSize& size : network.sizes)
    network.looks.emplace(size, training_look(training.items(), size, config));
  LookReport unlike;
  for (const DepthItem& item : validation.items())
    if (const auto look = network.looks.find(item.size); look != network.looks.end())
      unlike.add(item.name, compare(look->second, item));
  Value::Map unlike_lines;
  warn_of_unlike(unlike, "images of the validation", unlike_lines);
  if (config.shuffle_pairs) shuffle_depths(training.items(), config.seed);
  const std::int64_t weights = count_weights(network.module);
  log_info("{} images to train on, {} to judge by, {} weights", training.items().size(), validation.items().size(),
           weights);
  const std::vector<LearntEpoch> rows =
      train(network.module, training.items(), validation.items(), config, checkpoints_of(stage, "checkpoint"));
  save_script(network.module, stage.output("model.pt"));
  for (const ImageSize& size : network.sizes)
    write_file(stage.output(fmt::format("model_{}x{}.onnx", size.second, size.first)),
               depth_model_of(network.module, config.network, size, &network.looks.at(size)).to_onnx());
  write_history(stage, rows);
  const std::vector<double>& errors = rows.back().judged;
  Value::Map summary{{"images", training.items().size()},
                     {"weights", weights},
                     {kJudgedErrors[0], errors[0]},
                     {kJudgedErrors[1], errors[1]},
                     {"validation_images", validation.items().size()}};
  for (const std::size_t k : {2U, 3U})
    if (!validation.items().empty()) summary.emplace_back(kJudgedErrors[k], errors[k]);
  summary.insert(summary.end(), unlike_lines.begin(), unlike_lines.end());
  stage.summarize(summary);
}

void foretell_outcomes(Stage& stage, const OutcomeConfig& config) {
  if (!stage.optional_input("--shards")) throw UsageError("--config with task: outcome takes --shards");
  const auto shards = shards_of(stage);
  std::vector<GraspItem> items = read_grasps(shards, config.frames, make_outcome_network(config, config.seed));
  const auto checkpoints = [&](const std::string& name) {
    Checkpoints those = checkpoints_of(stage, "checkpoint_" + name);
    those.at_end = true;
    return those;
  };
  try {
    const OutcomeStudy study = study_outcomes(std::move(items), config, checkpoints);
    save_script(study.network, stage.output("model.pt"));
    write_file(stage.output("outcome.csv"), outcome_csv(study));
    write_file(stage.output("history.csv"), outcome_history_csv(study));
    write_file(stage.output("roc.svg"), roc_svg(study));
    write_file(stage.output("outcome.md"), outcome_page(study, config.frames));
    stage.summarize(outcome_summary(study));
  } catch (const DataError& error) {
    throw DataError("{}: {}", stage.input("--shards").string(), error.what());
  }
}

void train_network(Stage& stage) {
  const auto config = stage.read_config<TaskConfig>("--config");
  if (const auto* outcome = std::get_if<OutcomeConfig>(&config.task))
    foretell_outcomes(stage, *outcome);
  else
    train_depth(stage, std::get<DepthnetConfig>(config.task));
}

void judge_network(Stage& stage) {
  Judge judge(load_network(stage.inputs("--model")));
  for (const auto& [name, shard] : shards_of(stage))
    read_packed(shard, {"test"}, false, [&](const DepthImage& image) { judge.add(image); });
  judge.answer();
  if (judge.rows().empty())
    throw DataError("{}: names no images with contact of the split test", stage.input("--shards").string());
  write_file(stage.output("samples.csv"), to_csv(judge.rows()));
  write_png(stage.output("sheet.png"), judge.sheet());
  Value::Map summary = summary_of(judge.rows());
  if (judge.untouched() > 0)
    summary.emplace_back("without_contact",
                         Value::Map{{"images", judge.untouched()}, {"mean_answer_mm", judge.seen_untouched_mm()}});
  warn_of_unlike(judge.unlike(), "images of the split test", summary);
  stage.summarize(summary);
}

/// Task selected by the flags; each task has flags of its own.
void (*task_of(Stage& stage))(Stage&) {
  const bool config = stage.optional_input("--config").has_value(),
             shards = stage.optional_input("--shards").has_value(), renders = !stage.inputs("--renders").empty();
  if (config != stage.inputs("--model").empty())
    throw UsageError("give either --config, to train, or --model, to judge what was trained");
  if (config) {
    if (shards == renders) throw UsageError("training takes either --shards or --renders");
    if (shards && !stage.inputs("--validation").empty()) throw UsageError("--validation: goes with --renders");
    return train_network;
  }
  if (renders || !stage.inputs("--validation").empty()) throw UsageError("--renders, --validation: go with --config");
  if (!shards) throw UsageError("--model takes --shards, to judge it by; predict reads photographs");
  return judge_network;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kDepthnet, argc, argv, [](Stage& stage) {
    const auto task = task_of(stage);
    stay_in_this_thread();
    reserve_blas_memory(stage.threads());
    try {
      task(stage);
    } catch (const c10::Error& error) {
      throw SolverError("libtorch: {}", error.what_without_backtrace());
    }
  });
}
