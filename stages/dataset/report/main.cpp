#include <algorithm>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/image/image.h"
#include "common/stage/stage.h"
#include "stages/dataset/report/contact_sheet.h"
#include "stages/dataset/report/dataset/dataset_report.h"
#include "stages/dataset/report/page.h"
#include "stages/dataset/report/sample.h"

namespace {

using namespace tacipc;

const StageSpec kReport{
    .name = "report",
    .summary = "Show samples on one page, or a whole dataset on many: pictures, curves, verdicts, coverage, costs.",
    .inputs = {{.flag = "--sample",
                .help = "folder of a sample, with press and render in it",
                .required = false,
                .many = true},
               {.flag = "--plan", .help = "or of a dataset: samples.csv of plan", .required = false},
               {.flag = "--dataset", .help = "with --plan: dataset.yaml of plan", .required = false},
               {.flag = "--config", .help = "with --plan: how much is shown (YAML)", .required = false}},
    .options = {{.flag = "--title", .help = "heading of the page", .fallback = "Tactile samples"}}};

void report_samples(Stage& stage) {
  // A report that lies in a sample's folder is part of what the record hashes: an old one must not be.
  for (const char* name : {"index.html", "contact_sheet.png"}) {
    std::error_code error;
    std::filesystem::remove(stage.out() / name, error);
    if (error) throw DataError("{}: cannot be removed: {}", (stage.out() / name).string(), error.message());
  }
  std::vector<SampleReport> samples;
  for (const auto& folder : stage.inputs("--sample")) {
    samples.push_back(read_sample(folder));
    const SampleReport& sample = samples.back();
    if (!sample.passed()) log_warning("{}: failed: {}", sample.name, *sample.failure);
  }
  write_file(stage.output("index.html"), report_page(stage.option("--title"), samples, stage.out()));
  write_png(stage.output("contact_sheet.png"), contact_sheet(stage.option("--title"), samples));
  const auto passed = std::count_if(samples.begin(), samples.end(), [](const auto& s) { return s.passed(); });
  stage.summarize({{"samples", samples.size()},
                   {"passed", static_cast<std::int64_t>(passed)},
                   {"failed", static_cast<std::int64_t>(samples.size()) - passed}});
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kReport, argc, argv, [](Stage& stage) {
    const bool samples = !stage.inputs("--sample").empty();
    int of_dataset = 0;
    for (const char* flag : {"--plan", "--dataset", "--config"}) of_dataset += stage.optional_input(flag) ? 1 : 0;
    if (samples == (of_dataset > 0) || (!samples && of_dataset != 3))
      throw UsageError("give either --sample, once per sample, or --plan, --dataset and --config of a dataset");
    samples ? report_samples(stage) : report_dataset(stage);
  });
}
