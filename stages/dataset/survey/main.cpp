// What make asks of a planned dataset: how far it is, what it costs, what its shards are packed from, what may go.
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

/// Runs what a command asks for; messages begin with `what`. Returns the exit code.
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

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("What of a planned dataset is made, what the rest will cost, and what make needs to be told of it.",
               "survey");
  app.require_subcommand(1);
  app.set_version_flag("--version", "survey " + program_version());
  add_answers(app, {});
  fs::path dataset, model, profile;
  int code = 0;
  const auto command = [&](const char* name, const char* summary) {
    CLI::App* sub = app.add_subcommand(name, summary);
    sub->add_option("dataset", dataset, "folder of the dataset")->required()->type_name("DATASET");
    return sub;
  };

  CLI::App* status = command("status", "How many samples are made, failed, running, and how fast");
  bool all_made = false;
  IndexRange range;
  status->add_flag("--all-made", all_made, "exit code 1 unless every sample is made");
  auto* end = status->add_option("--end", range.end, "only samples with an index below")->type_name("INDEX");
  status->add_option("--first", range.first, "only samples from this index on")->type_name("INDEX")->needs(end);
  status->callback([&] {
    code = run("status", [&] {
      const DatasetStatus found = dataset_status(dataset, range, std::time(nullptr));
      fmt::print("{}", to_text(found, dataset));
      if (!all_made || found.made == found.samples) return 0;
      std::fflush(stdout);
      fmt::print(stderr, "{}: {} of {} samples are not made\n", name_of_dataset(dataset), found.samples - found.made,
                 found.samples);
      return 1;
    });
  });

  CLI::App* estimate =
      command("estimate", "Core-hours and disk of the whole dataset; exit code 1 if the disk has no room");
  estimate->add_option("--model", model, "what a press costs (YAML, of bench-press)")->required()->type_name("FILE");
  estimate->callback([&] {
    code = run("estimate", [&] {
      const CostEstimate cost = estimate_cost(dataset, read_config<CostModel>(model));
      fmt::print("{}", to_text(cost, dataset));
      std::fflush(stdout);
      const double free = free_bytes(dataset);
      if (cost.bytes_left > free)
        throw DataError("{:.3g} GB are still needed, but the disk has {:.3g} GB left", cost.bytes_left / 1e9,
                        free / 1e9);
      return 0;
    });
  });

  CLI::App* pilot = command("pilot", "Samples to measure on before an estimate, spread over the plan");
  std::size_t count = 0;
  pilot->add_option("count", count, "how many")->required();
  pilot->callback([&] {
    code = run("estimate", [&] {
      fmt::print("{}\n", fmt::join(pilot_samples(dataset, count), "\n"));
      return 0;
    });
  });

  CLI::App* pack_inputs = command("pack-inputs", "Files in shards/ that change when what is packed into a shard does");
  pack_inputs->add_option("profile", profile, "what is packed (YAML)")->required()->type_name("PROFILE");
  pack_inputs->callback([&] {
    code = run("pack", [&] {
      write_pack_inputs(dataset, profile);
      return 0;
    });
  });

  CLI::App* drop = command("drop", "Remove what stages wrote for packed samples, but records, times and logs");
  bool whole_shards = false;
  std::vector<std::string> stages;
  drop->add_flag("--whole-shards", whole_shards, "only of shards in which no sample failed");
  drop->add_option("stages", stages, "of which the files go (none: nothing is done)")->type_name("STAGE");
  drop->callback([&] {
    if (stages.empty()) return;
    code = run("drop", [&] {
      const Dropped dropped = drop_packed(dataset, stages, whole_shards);
      const std::string name = name_of_dataset(dataset);
      if (dropped.stages > 0)
        fmt::print("{}: files of {} stages dropped ({})\n", name, dropped.stages, fmt::join(stages, " "));
      std::fflush(stdout);
      if (dropped.samples > 0)
        fmt::print(stderr, "{}: {} samples are not as they were packed, or are being made, and keep their files\n",
                   name, dropped.samples);
      return 0;
    });
  });

  try {
    app.parse(argc, argv);
  } catch (const Answer& answer) {
    return print_answer(answer);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    fmt::print(stderr, "survey: error: {} (see survey --help)\n", printable(error.what()));
    return 2;
  }
  return code;
}
