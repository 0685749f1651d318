#include <fmt/core.h>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/csv.h"
#include "common/error.h"
#include "common/files.h"
#include "common/image.h"
#include "common/stage.h"
#include "stages/depth_metrics/depth_error.h"

namespace {

using namespace tacipc;
namespace fs = std::filesystem;

const StageSpec kDepthMetrics{
    .name = "depth_metrics",
    .summary = "Compare maps of depths with references: errors in mm, slopes, what is pressed.",
    .inputs = {{.flag = "--config", .help = "what counts as pressed (YAML)"},
               {.flag = "--images", .help = "depth maps (EXR, channel Z, m)", .many = true},
               {.flag = "--reference", .help = "as many depth maps, in the same order", .many = true},
               {.flag = "--rest", .help = "depth map of the gel at rest"}}};

struct Column {
  const char* name;
  double DepthError::*value;
  double per_unit;  // from SI to the table's unit
};

constexpr std::array kColumns = {Column{"mae_mm", &DepthError::mae_m, 1e3},
                                 Column{"mse_mm2", &DepthError::mse_m2, 1e6},
                                 Column{"max_mm", &DepthError::max_m, 1e3},
                                 Column{"mae_norm", &DepthError::mae_norm, 1.0},
                                 Column{"slope_ratio", &DepthError::slope_ratio, 1.0},
                                 Column{"iou", &DepthError::iou, 1.0}};

FloatImage read_depth(const fs::path& file, const FloatImage* like) {
  FloatImage map = read_exr(file, {"Z"});
  if (like && (map.width != like->width || map.height != like->height))
    throw DataError("{}: is {} x {} pixels, the gel at rest {} x {}", file.string(), map.width, map.height, like->width,
                    like->height);
  return map;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kDepthMetrics, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<DepthMetricsConfig>("--config");
    const auto& images = stage.inputs("--images");
    const auto& references = stage.inputs("--reference");
    if (images.size() != references.size())
      throw UsageError(fmt::format("{} images but {} references: lists are compared pair by pair", images.size(),
                                   references.size()));
    const FloatImage rest = read_depth(stage.input("--rest"), nullptr);
    const std::vector<std::string> names = short_names(images);
    std::string table = "name,region,pixels";
    for (const Column& column : kColumns) table += fmt::format(",{}", column.name);
    table += '\n';
    std::map<std::string, std::array<double, kColumns.size()>> sums;
    for (std::size_t i = 0; i < images.size(); ++i) {
      const FloatImage image = read_depth(images[i], &rest), reference = read_depth(references[i], &rest);
      DepthErrors errors;
      try {
        errors = depth_errors(image, reference, rest, config);
      } catch (const DataError& error) {
        throw DataError("{} against {}: {}", images[i].string(), references[i].string(), error.what());
      }
      for (const auto& [region, error] : {std::pair{"full", errors.full}, std::pair{"pressed", errors.pressed}}) {
        std::vector<std::string> fields{names[i], region, fmt::format("{}", error.pixels)};
        for (std::size_t c = 0; c < kColumns.size(); ++c) {
          const double value = kColumns[c].per_unit * (error.*kColumns[c].value);
          fields.push_back(fmt::format("{}", value));
          sums[region][c] += value / static_cast<double>(images.size());
        }
        table += csv_line(fields);
      }
    }
    write_file(stage.output("samples.csv"), table);
    Value::Map summary{{"images", images.size()}};
    for (const auto& [region, means] : sums) {
      Value::Map lines;
      for (std::size_t c = 0; c < kColumns.size(); ++c) lines.emplace_back(kColumns[c].name, means[c]);
      summary.emplace_back(region, std::move(lines));
    }
    stage.summarize(summary);
  });
}
