#include "common/files.h"
#include "common/image.h"
#include "common/log.h"
#include "common/stage.h"
#include "stages/metrics/metrics_table.h"

namespace {

using namespace tacipc;

const StageSpec kMetrics{
    .name = "metrics",
    .summary = "Compare tactile images with references: MAE, MSE, PSNR, SSIM.",
    .inputs = {{.flag = "--config", .help = "which images, which part of them (YAML)"},
               {.flag = "--images", .help = "folder of PNGs, or PNG files", .many = true},
               {.flag = "--reference", .help = "folder with the same names, or as many PNG files", .many = true}}};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kMetrics, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<MetricsConfig>("--config");
    const auto pairs = pair_images(stage.inputs("--images"), stage.inputs("--reference"), config.ends_with);
    log_info("{} pairs of images", pairs.size());
    const auto rows = measure(pairs, config);
    write_file(stage.output("samples.csv"), to_csv(rows));
    stage.summarize(summary_of(rows));
  });
}
