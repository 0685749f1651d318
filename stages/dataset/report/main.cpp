#include <algorithm>
#include <optional>
#include <stdexcept>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/image/image.h"
#include "common/stage/stage.h"
#include "stages/dataset/report/card.h"
#include "stages/dataset/report/contact_sheet.h"
#include "stages/dataset/report/dataset/dataset_report.h"
#include "stages/dataset/report/grasp_part.h"
#include "stages/dataset/report/page.h"
#include "stages/dataset/report/sample.h"
#include "stages/dataset/report/view/view_data.h"
#include "stages/dataset/report/view/view_page.h"

namespace {

using namespace tacipc;

const StageSpec kReport{
    .name = "report",
    .summary = "Show samples on one page, or a whole dataset on many: pictures, curves, verdicts, coverage, costs.",
    .inputs = {{.flag = "--sample",
                .help = "folder of a sample, with press and render in it",
                .required = false,
                .many = true},
               {.flag = "--grasp", .help = "or folder of a grasp, with left and right in it", .required = false},
               {.flag = "--plan", .help = "or of a dataset: samples.csv of plan", .required = false},
               {.flag = "--dataset", .help = "with --plan: dataset.yaml of plan", .required = false},
               {.flag = "--config", .help = "with --plan: how much is shown (YAML)", .required = false}},
    .options = {{.flag = "--title", .help = "heading of the page", .fallback = "Tactile samples"}}};

/// Writes the data of a sample's view. A view shows a sample but proves nothing: one that cannot be read is left out.
void write_view(Stage& stage, SampleReport& sample, const std::string& card) {
  std::string script;
  try {
    const auto view = read_press_view(sample.folder / "press");
    if (!view) return;
    script = view_script(*view, frame_texts(sample, *view));
  } catch (const std::runtime_error& error) {
    log_warning("{}: no 3-D view: {}", sample.name, error.what());
    return;
  }
  write_file(stage.output(view_data_name(card)), script);
  sample.has_view = true;
}

void write_views(Stage& stage, std::vector<SampleReport>& samples) {
  std::vector<ViewedSample> viewed;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    write_view(stage, samples[i], card_id(i));
    if (samples[i].has_view) viewed.push_back({card_id(i), samples[i].name});
  }
  if (viewed.empty()) return;
  write_file(stage.output(kViewScript), view_program());
  write_file(stage.output(kViewPage), view_page(stage.option("--title"), viewed));
}

/// Before any is shown: a picture that cannot be read makes its own sample a failed one, and does not end the page of
/// all.
void try_pictures(SampleReport& sample) {
  if (!sample.images) return;
  const SampleImages& images = *sample.images;
  try {
    for (const auto& file : {std::optional(images.tactile), std::optional(images.no_contact), images.indentation,
                             images.normal, images.markers})
      if (file) read_picture(*file);
    for (const PhaseImage& phase : sample.phase_images) read_picture(phase.tactile);
  } catch (const std::runtime_error& error) {
    leave_out_pictures(sample, error.what());
  }
}

void report_samples(Stage& stage) {
  // A report that lies in a sample's folder is part of what the record hashes: an old one must not be.
  for (const char* name : {"index.html", "contact_sheet.png", kViewPage, "view"}) {
    std::error_code error;
    std::filesystem::remove_all(stage.out() / name, error);
    if (error) throw DataError("{}: cannot be removed: {}", (stage.out() / name).string(), error.message());
  }
  const auto grasp = stage.optional_input("--grasp");
  std::vector<std::filesystem::path> folders = stage.inputs("--sample");
  std::string first;
  if (grasp) {
    const GraspReport report = read_grasp(*grasp);
    write_file(stage.output(kGraspPlot), grasp_plot(report));
    write_png(stage.output(kGraspStrip), grasp_strip(*grasp, report.moments.size()));
    first = grasp_section(report);
    folders = {*grasp / "left", *grasp / "right"};
  }
  std::vector<SampleReport> samples;
  for (const auto& folder : folders) {
    samples.push_back(read_sample(folder));
    if (grasp) samples.back().name = folder.filename().string() + " finger";
    SampleReport& sample = samples.back();
    try_pictures(sample);
    if (!sample.passed()) log_warning("{}: failed: {}", sample.name, *sample.failure);
  }
  write_views(stage, samples);
  write_file(stage.output("index.html"), report_page(stage.option("--title"), samples, stage.out(), first));
  write_png(stage.output("contact_sheet.png"), contact_sheet(stage.option("--title"), samples));
  const auto passed = std::count_if(samples.begin(), samples.end(), [](const auto& s) { return s.passed(); });
  stage.summarize({{"samples", samples.size()},
                   {"passed", static_cast<std::int64_t>(passed)},
                   {"failed", static_cast<std::int64_t>(samples.size()) - passed}});
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kReport, argc, argv, [](Stage& stage) {
    const bool samples = !stage.inputs("--sample").empty() || stage.optional_input("--grasp");
    if (!stage.inputs("--sample").empty() && stage.optional_input("--grasp"))
      throw UsageError("give either --sample or --grasp, not both");
    int of_dataset = 0;
    for (const char* flag : {"--plan", "--dataset", "--config"}) of_dataset += stage.optional_input(flag) ? 1 : 0;
    if (samples == (of_dataset > 0) || (!samples && of_dataset != 3))
      throw UsageError(
          "give either --sample, once per sample, or --grasp, or --plan, --dataset and --config of a dataset");
    samples ? report_samples(stage) : report_dataset(stage);
  });
}
