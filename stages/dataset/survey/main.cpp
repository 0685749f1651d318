// Answers make's queries on a planned dataset: progress, costs, inputs of shards, removable files.
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sys/statvfs.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <functional>

#include "common/base/error.h"
#include "common/base/printable.h"
#include "common/stage/self_description.h"
#include "common/stage/stage.h"
#include "stages/dataset/survey/cost_estimate.h"
#include "stages/dataset/survey/drop.h"
#include "stages/dataset/survey/pack_inputs.h"
#include "stages/dataset/survey/plan_lock.h"
#include "stages/dataset/survey/status.h"

namespace {

using namespace tacipc;
namespace fs = std::filesystem;

double free_bytes(const fs::path& folder) {
  struct statvfs disk {};
  if (::statvfs(folder.c_str(), &disk) != 0) throw DataError("{}: {}", folder.string(), std::strerror(errno));
  return static_cast<double>(disk.f_frsize) * static_cast<double>(disk.f_bavail);
}

/// Runs a command; messages begin with `what`.
/// \return exit code
int run(const char* what, const std::function<int()>& body) {
  try {
    return body();
  } catch (const ConfigError& error) {
    fmt::print(stderr, "{}\n", printable(error.what()));
    return 2;
  } catch (const UsageError& error) {
    fmt::print(stderr, "{}: {}\n", what, printable(error.what()));
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", what, printable(error.what()));
    return 1;
  }
}

/// Flags of all commands.
struct Flags {
  fs::path dataset, model, profile;
  IndexRange range;
  std::size_t count = 0;
  bool all_made = false, whole_shards = false;
  std::vector<std::string> stages;
};

int print_status(const Flags& flags) {
  const DatasetStatus found = dataset_status(flags.dataset, flags.range, std::time(nullptr));
  fmt::print("{}", to_text(found, flags.dataset));
  if (!flags.all_made || found.made == found.samples) return 0;
  std::fflush(stdout);
  fmt::print(stderr, "{}: {} of {} samples are not made\n", name_of_dataset(flags.dataset), found.samples - found.made,
             found.samples);
  return 1;
}

int print_cost(const Flags& flags) {
  const CostEstimate cost = estimate_cost(flags.dataset, read_config<CostModel>(flags.model));
  fmt::print("{}", to_text(cost, flags.dataset));
  std::fflush(stdout);
  const double free = free_bytes(flags.dataset);
  if (cost.bytes_left > free)
    throw DataError("{:.3g} GB are still needed, but the disk has {:.3g} GB left", cost.bytes_left / 1e9, free / 1e9);
  return 0;
}

int print_pilot(const Flags& flags) {
  fmt::print("{}\n", fmt::join(pilot_samples(flags.dataset, flags.count), "\n"));
  return 0;
}

int update_pack_inputs(const Flags& flags) {
  write_pack_inputs(flags.dataset, flags.profile);
  return 0;
}

int drop(const Flags& flags) {
  if (flags.stages.empty()) return 0;
  const Dropped dropped = drop_packed(flags.dataset, flags.stages, flags.whole_shards);
  const std::string name = name_of_dataset(flags.dataset);
  if (dropped.stages > 0)
    fmt::print("{}: files of {} stages dropped ({})\n", name, dropped.stages, fmt::join(flags.stages, " "));
  std::fflush(stdout);
  if (dropped.samples > 0)
    fmt::print(stderr, "{}: {} samples are not as they were packed, or are being made, and keep their files\n", name,
               dropped.samples);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("What of a planned dataset is made, what the rest will cost, and what make needs to be told of it.",
               "survey");
  app.require_subcommand(1);
  app.set_version_flag("--version", "survey " + program_version());
  add_answers(app, {});
  Flags flags;
  int code = 0;
  const auto command = [&](const char* name, const char* summary, const char* what, int (*body)(const Flags&)) {
    CLI::App* sub = app.add_subcommand(name, summary);
    sub->add_option("dataset", flags.dataset, "folder of the dataset")->required()->type_name("DATASET");
    sub->callback([&flags, &code, what, body] { code = run(what, [&] { return body(flags); }); });
    return sub;
  };

  CLI::App* status =
      command("status", "How many samples are made, failed, running, and how fast", "status", print_status);
  status->add_flag("--all-made", flags.all_made, "exit code 1 unless every sample is made");
  auto* end = status->add_option("--end", flags.range.end, "only samples with an index below")->type_name("INDEX");
  status->add_option("--first", flags.range.first, "only samples from this index on")->type_name("INDEX")->needs(end);

  CLI::App* estimate =
      command("estimate", "Core-hours and disk of the whole dataset; exit code 1 if the disk has no room", "estimate",
              print_cost);
  estimate->add_option("--model", flags.model, "what a press costs (YAML, of bench-press)")
      ->required()
      ->type_name("FILE");

  CLI::App* pilot =
      command("pilot", "Samples to measure on before an estimate, spread over the plan", "estimate", print_pilot);
  pilot->add_option("count", flags.count, "how many")->required();

  CLI::App* pack_inputs = command("pack-inputs", "Files in shards/ that change when what is packed into a shard does",
                                  "pack", update_pack_inputs);
  pack_inputs->add_option("profile", flags.profile, "what is packed (YAML)")->required()->type_name("PROFILE");

  CLI::App* drops =
      command("drop", "Remove what stages wrote for packed samples, but records, times and logs", "drop", drop);
  drops->add_flag("--whole-shards", flags.whole_shards, "only of shards in which no sample failed");
  drops->add_option("stages", flags.stages, "of which the files go (none: nothing is done)")->type_name("STAGE");

  if (const auto answered = parse_flags(app, argc, argv, "survey --help")) return *answered;
  return code;
}
