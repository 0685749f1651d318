#include <variant>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/stage/stage.h"
#include "stages/study/metrics/measure.h"

namespace {

using namespace tacipc;

const StageSpec kMetrics{
    .name = "metrics",
    .summary = "Compare tactile images or depth maps with references: MAE, MSE, PSNR, SSIM; errors in mm, slopes.",
    .inputs = {
        {"--config", "images or depth maps, which of them, which part (YAML)"},
        InputSpec::several("--images", "folder of images (PNG) or depth maps (EXR, m), or files"),
        InputSpec::several("--reference", "folder with the same names, or as many files"),
        InputSpec::optional("--rest", "depth map of the gel at rest, for depth maps"),
        InputSpec::any_number(
            "--surface", "depth maps of the object's surface, for the region contact: as many files as --images")}};

std::vector<MetricsRow> measure(Stage& stage, const MetricsConfig& config) {
  const auto rest = stage.optional_input("--rest");
  const auto* depth = std::get_if<DepthMetrics>(&config.what);
  if (depth && !rest) throw UsageError("--rest: is needed where depth maps are compared");
  if (!depth && rest) throw UsageError("--rest: is for depth maps, and the configuration is for images");
  const auto& surfaces = stage.inputs("--surface");
  if (surfaces.empty() == (depth && depth->regions.contact_m > 0.0))
    throw UsageError("--surface: belongs to a configuration with contact_mm");
  auto pairs = pair_images(stage.inputs("--images"), stage.inputs("--reference"), config.ends_with);
  if (!surfaces.empty() && (surfaces.size() != pairs.size() || surfaces.size() != stage.inputs("--images").size()))
    throw UsageError(fmt::format("--surface: {} files for {} images", surfaces.size(), pairs.size()));
  for (std::size_t i = 0; i < surfaces.size(); ++i) pairs[i].surface = surfaces[i];
  log_info("{} pairs", pairs.size());
  return depth ? measure_depths(pairs, *rest, *depth) : measure_images(pairs, std::get<ImageMetrics>(config.what));
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kMetrics, argc, argv, [](Stage& stage) {
    const auto rows = measure(stage, stage.read_config<MetricsConfig>("--config"));
    write_file(stage.output("samples.csv"), to_csv(rows));
    stage.summarize(summary_of(rows));
  });
}
