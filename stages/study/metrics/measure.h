// Measures tactile images and depth maps against references.
#pragma once

#include <filesystem>
#include <vector>

#include "common/benchmark/metrics_rows.h"
#include "stages/study/metrics/image_pairs.h"
#include "stages/study/metrics/metrics_config.h"

namespace tacipc {

/// Rows of each image pair: one for the whole image (`full`), then those of its `crop` and `box`.
/// \throw DataError for unreadable images, different sizes, images below 11 pixels, a crop or box that leaves the
/// image, or an image without a box
std::vector<MetricsRow> measure_images(const std::vector<ImagePair>& pairs, const ImageMetrics& config);

/// Rows of each map pair: one for the whole map (`full`), one for the pixels where the reference is `pressed`, and the
/// requested regions.
/// \param rest depth map of the gel at rest
/// \throw DataError for unreadable maps or maps of another size, and as depth_errors
std::vector<MetricsRow> measure_depths(const std::vector<ImagePair>& pairs, const std::filesystem::path& rest,
                                       const DepthMetrics& config);

}  // namespace tacipc
