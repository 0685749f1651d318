#include <algorithm>

#include "common/error.h"
#include "common/files.h"
#include "common/stage.h"
#include "stages/comparison/method_table.h"
#include "stages/comparison/sheet.h"

namespace {

using namespace tacipc;

const StageSpec kComparison{
    .name = "comparison",
    .summary = "Our images beside photographs and the rivals: a table and a sheet of pictures.",
    .inputs = {{.flag = "--config", .help = "the benchmark (YAML)"},
               {.flag = "--circles", .help = "contact circles, where the benchmark names them", .required = false},
               {.flag = "--ours", .help = "samples.csv of our images"},
               {.flag = "--depth-based", .help = "samples.csv of the depth-based method"},
               {.flag = "--background", .help = "samples.csv of the background alone"},
               {.flag = "--real-images", .help = "photographs, in the benchmark's order", .many = true},
               {.flag = "--our-images", .help = "our images, in the same order", .many = true},
               {.flag = "--rival-images", .help = "the depth-based method's images, in the same order", .many = true}}};

std::vector<ByteImage> read_all(Stage& stage, const std::string& flag, std::size_t count) {
  const auto& paths = stage.inputs(flag);
  if (paths.size() != count)
    throw UsageError(fmt::format("{}: {} images, the benchmark has {}", flag, paths.size(), count));
  std::vector<ByteImage> images;
  for (const auto& path : paths) {
    images.push_back(read_png(path, 3));
    if (images.back().width != images.front().width || images.back().height != images.front().height)
      throw DataError("{}: is not of the size of {}", path.string(), paths.front().string());
  }
  return images;
}

Value::Map values_of(const Score& s) {
  return {{"ssim_s", s.ssim_s}, {"ssim_w", s.ssim_w}, {"mae", s.mae}, {"psnr_db", s.psnr_db}};
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kComparison, argc, argv, [](Stage& stage) {
    auto cases = stage.read_config<BenchmarkCases>("--config");
    add_circles(cases, stage.optional_input("--circles"));
    const std::vector<MethodScores> methods{read_scores(stage.input("--ours"), "ours", cases),
                                            read_scores(stage.input("--depth-based"), "depth-based", cases),
                                            read_scores(stage.input("--background"), "background alone", cases)};
    const std::size_t count = methods.front().box.size();
    const auto real = read_all(stage, "--real-images", count), ours = read_all(stage, "--our-images", count),
               rival = read_all(stage, "--rival-images", count);
    std::vector<SheetRow> rows;
    for (const ObjectCase& object : cases.objects)
      for (std::size_t k = 0; k < object.images.size(); ++k) {
        const std::size_t i = rows.size();
        for (const auto* image : {&ours[i], &rival[i]})
          if (image->width != real[i].width || image->height != real[i].height)
            throw DataError("{}: images are not of the photograph's size", object.images[k].name);
        const auto& box = object.images[k].box_px;
        if (box[0] + box[2] > real[i].width || box[1] + box[3] > real[i].height)
          throw DataError("{}: the contact box leaves the photograph", object.images[k].name);
        rows.push_back({real[i], ours[i], rival[i], box});
      }
    write_file(stage.output("table.md"), to_markdown(methods, cases));
    write_png(stage.output("sheet.png"), sheet(rows));
    const Verdict verdict = judge(methods, cases);
    Value::Map summary{{"holds", verdict.musts && verdict.ahead}, {"musts", verdict.musts}, {"ahead", verdict.ahead}};
    for (const MethodScores& method : methods)
      summary.emplace_back(
          method.name, Value::Map{{"box", values_of(mean_of(method.box))}, {"full", values_of(mean_of(method.full))}});
    stage.summarize(summary);
  });
}
