#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <set>

#include "common/base/each_in_threads.h"
#include "common/base/error.h"
#include "common/base/log.h"
#include "common/benchmark/depth_model.h"
#include "common/image/depth_sheet.h"
#include "common/image/picture.h"
#include "common/stage/stage.h"
#include "stages/image/predict/depth_reader.h"

namespace {

using namespace tacipc;
namespace fs = std::filesystem;

const StageSpec kPredict{
    .name = "predict",
    .summary = "Depth of photographs by a network of depthnet.",
    .inputs = {{.flag = "--model", .help = "model_<width>x<height>.onnx of a training"},
               {.flag = "--images", .help = "photographs to read (PNG)", .many = true},
               {.flag = "--background", .help = "photograph without contact, their reference (PNG)"},
               {.flag = "--rest",
                .help = "depth map of the gel at rest (EXR, m): depth maps of the photographs are written, too",
                .required = false},
               {.flag = "--truth",
                .help = "their true depth maps (EXR, m), as many, for a sheet of pictures",
                .required = false,
                .many = true}},
    .options = {
        {.flag = "--strict",
         .help = "photographs unlike those of the network's training, or which cannot be compared, are an error",
         .is_switch = true}}};

/// Indentation of a depth map relative to that of the gel at rest, mm.
FloatImage indentation_mm(const FloatImage& rest_m, FloatImage depth_m) {
  for (std::size_t i = 0; i < rest_m.pixels.size(); ++i)
    depth_m.pixels[i] = 1e3F * (rest_m.pixels[i] - depth_m.pixels[i]);
  return depth_m;
}

void check_flags(Stage& stage) {
  const auto& truths = stage.inputs("--truth");
  if (!truths.empty() && (!stage.optional_input("--rest") || truths.size() != stage.inputs("--images").size()))
    throw UsageError("--truth: needs --rest, and a map for each of --images");
  std::set<std::string> names;
  for (const fs::path& file : stage.inputs("--images"))
    if (!names.insert(file.stem().string()).second)
      throw UsageError(fmt::format("--images: two are called {}", file.stem().string()));
}

/// Logs photographs that differ from those of the network's training.
/// \return lines of the summary
Value::Map compare_with_training(Stage& stage, const DepthModel& model, const ByteImage& reference,
                                 const std::vector<ByteImage>& images) {
  const bool strict = !stage.option("--strict").empty();
  const std::string model_name = stage.input("--model").string();
  if (!model.look) {
    const std::string text = model_name +
                             ": does not say what its training's images looked like (an earlier version wrote "
                             "it), so photographs cannot be compared with them";
    if (strict) throw DataError(text);
    log_warning("{}", text);
    return {};
  }
  const TrainedLook& look = *model.look;
  const FloatImage background = means_over_squares(reference, look.reduction());
  const auto& files = stage.inputs("--images");
  std::vector<LookComparison> comparisons(images.size());
  each_in_threads(images.size(), [&](std::size_t i) {
    check_size(model, files[i].string(), images[i], reference);
    comparisons[i] = look.compare(background, means_over_squares(images[i], look.reduction()));
  });
  LookReport report;
  Value::Map distances;
  for (std::size_t i = 0; i < files.size(); ++i) {
    report.add(files[i].stem().string(), comparisons[i]);
    distances.emplace_back(files[i].stem().string(), comparisons[i].distance);
  }
  const std::vector<std::string> warnings = report.warnings("photographs");
  if (strict && !warnings.empty()) throw DataError("{}: {}", model_name, fmt::join(warnings, "; "));
  for (const std::string& warning : warnings) log_warning("{}", warning);
  return {{"unlike_training", report.summary()}, {"distance_from_training", distances}};
}

void predict(Stage& stage) {
  check_flags(stage);
  const ByteImage reference = read_png(stage.input("--background"), 3);
  const auto read_map = [&](const fs::path& file) {
    FloatImage map = read_exr(file, {"Y"});
    if (map.width != reference.width || map.height != reference.height)
      throw DataError("{}: has {} x {} pixels, the reference {} x {}", file.string(), map.width, map.height,
                      reference.width, reference.height);
    return map;
  };
  const auto rest_file = stage.optional_input("--rest");
  const FloatImage rest = rest_file ? read_map(*rest_file) : FloatImage();
  const auto &files = stage.inputs("--images"), &truths = stage.inputs("--truth");
  const DepthModel model = read_depth_model(stage.input("--model"));
  std::vector<ByteImage> images(files.size());
  std::vector<FloatImage> answers(files.size());
  set_up_opencv();
  tbb::enumerable_thread_specific<DepthReader> readers(
      [&] { return DepthReader(model, stage.input("--model").string()); });
  each_in_threads(files.size(), [&](std::size_t i) { images[i] = read_png(files[i], 3); });
  const Value::Map compared = compare_with_training(stage, model, reference, images);
  each_in_threads(files.size(), [&](std::size_t i) {
    answers[i] = readers.local().depth_mm(files[i].string(), images[i], reference);
  });
  Value::Map deepest;
  std::vector<DepthRow> rows;
  for (std::size_t i = 0; i < files.size(); ++i) {
    FloatImage map = answers[i];
    const std::string name = files[i].stem().string();
    deepest.emplace_back(name, double{*std::ranges::max_element(map.pixels)});
    for (float& depth : map.pixels) depth *= 1e-3F;
    write_png(stage.output("indentation/" + name + ".png"), picture_of_height(map));
    write_exr(stage.output("indentation/" + name + ".exr"), map, {"Y"});
    if (!rest_file) continue;
    for (std::size_t k = 0; k < map.pixels.size(); ++k) map.pixels[k] = rest.pixels[k] - map.pixels[k];
    write_exr(stage.output("depth/" + name + ".exr"), map, {"Y"});
    if (!truths.empty()) rows.push_back({images[i], indentation_mm(rest, read_map(truths[i])), answers[i]});
  }
  if (!rows.empty()) write_png(stage.output("sheet.png"), depth_sheet(rows));
  stage.summarize({{"images", deepest.size()}, {"deepest_mm", deepest}});
  stage.summarize(compared);
}

}  // namespace

int main(int argc, char** argv) { return run_stage(kPredict, argc, argv, predict); }
