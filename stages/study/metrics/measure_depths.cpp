#include "stages/study/metrics/measure.h"

#include <optional>

#include "common/base/error.h"
#include "common/benchmark/depth_error.h"
#include "common/image/image.h"
#include "stages/study/metrics/measure_pairs.h"

namespace tacipc {
namespace {

FloatImage read_depth(const std::filesystem::path& file) { return read_exr(file, {"Y"}); }

FloatImage read_depth_like(const std::filesystem::path& file, const FloatImage& rest) {
  FloatImage map = read_depth(file);
  if (map.width != rest.width || map.height != rest.height)
    throw DataError("{}: is {} x {} pixels, the gel at rest {} x {}", file.string(), map.width, map.height, rest.width,
                    rest.height);
  return map;
}

}  // namespace

std::vector<MetricsRow> measure_depths(const std::vector<ImagePair>& pairs, const std::filesystem::path& rest,
                                       const DepthMetrics& config) {
  const FloatImage at_rest = read_depth(rest);
  return measure_pairs(pairs, [&](const ImagePair& pair) -> std::vector<MetricsRow> {
    const FloatImage map = read_depth_like(pair.image, at_rest), reference = read_depth_like(pair.reference, at_rest);
    std::optional<FloatImage> surface;
    if (!pair.surface.empty()) surface = read_depth_like(pair.surface, at_rest);
    try {
      const DepthErrors errors = depth_errors(map, reference, at_rest, config.regions, surface ? &*surface : nullptr);
      std::vector<MetricsRow> rows{row_of(pair.name, "full", errors.full),
                                   row_of(pair.name, "pressed", errors.pressed)};
      if (errors.contact) rows.push_back(row_of(pair.name, "contact", *errors.contact));
      if (errors.beside) rows.push_back(row_of(pair.name, "beside", *errors.beside));
      return rows;
    } catch (const DataError& error) {
      throw DataError("{} against {}: {}", pair.image.string(), pair.reference.string(), error.what());
    }
  });
}

}  // namespace tacipc
