#include "stages/study/metrics/measure.h"

#include <algorithm>
#include <optional>

#include "common/base/each_in_threads.h"
#include "common/base/error.h"
#include "common/benchmark/depth_error.h"
#include "common/image/image.h"
#include "stages/study/metrics/image_error.h"
#include "stages/study/metrics/sharpness.h"
#include "stages/study/metrics/ssim.h"

namespace tacipc {
namespace {

/// Rows of all pairs in their order; pairs run in parallel. If several fail, the first one's error is thrown.
template <typename Measure>
std::vector<MetricsRow> measure_pairs(const std::vector<ImagePair>& pairs, const Measure& measure) {
  std::vector<std::vector<MetricsRow>> of_pair(pairs.size());
  each_in_threads(pairs.size(), [&](std::size_t i) { of_pair[i] = measure(pairs[i]); });
  std::vector<MetricsRow> rows;
  for (const auto& some : of_pair) rows.insert(rows.end(), some.begin(), some.end());
  return rows;
}

ByteImage cropped(const ByteImage& image, const Box& box) {
  ByteImage out(box.width, box.height, image.channels);
  const auto width = static_cast<std::size_t>(box.width * image.channels);
  for (int y = 0; y < box.height; ++y) std::copy_n(&image.at(box.x, box.y + y, 0), width, &out.at(0, y, 0));
  return out;
}

MetricsRow row_of(const ImagePair& pair, const char* region, const ImageError& error, double ssim_w, double ssim_s,
                  double sharpness) {
  return {.name = pair.name,
          .region = region,
          .values = {{"mae", error.mae},
                     {"mse", error.mse},
                     {"psnr_db", psnr_db(error.mse)},
                     {"psnr_ln", psnr_ln(error.mse)},
                     {"ssim_w", ssim_w},
                     {"ssim_s", ssim_s},
                     {"sharpness", sharpness}}};
}

MetricsRow compare(const ByteImage& image, const ByteImage& reference, const ImagePair& pair, const char* region) {
  return row_of(pair, region, image_error(image, reference), ssim(image, reference, gaussian_window()),
                ssim(image, reference, box_window()), sharpness(image, reference, {0, 0, image.width, image.height}));
}

/// Row of a box: errors of its pixels, SSIM and sharpness from the whole image's maps there.
MetricsRow compare_in_box(const ByteImage& image, const ByteImage& reference, const Box& box, const ImagePair& pair) {
  return row_of(pair, "box", image_error(cropped(image, box), cropped(reference, box)),
                ssim_in_box(image, reference, gaussian_window(), box), ssim_in_box(image, reference, box_window(), box),
                sharpness(image, reference, box));
}

void check_inside(const Box& box, const ByteImage& image, const ImagePair& pair, const char* key) {
  if (box.x + box.width <= image.width && box.y + box.height <= image.height) return;
  throw DataError("{}: is {} x {} pixels, {} reaches to {} x {}", pair.image.string(), image.width, image.height, key,
                  box.x + box.width, box.y + box.height);
}

/// Box of the image, if one is configured.
/// \throw DataError if it does not fit, has no pixel with a whole window, or leaves no pixel outside for an offset that
/// must be fitted there
const Box* checked_box(const ByteImage& image, const ImagePair& pair, const ImageMetrics& config) {
  if (config.boxes.empty()) return nullptr;
  const Box* box = config.box_of(pair.name);
  if (!box) throw DataError("{}: no box of the configuration begins as its name, {}", pair.image.string(), pair.name);
  check_inside(*box, image, pair, "boxes");
  constexpr int kMargin = kLeastSide / 2;
  if (box->x + box->width <= kMargin || box->x >= image.width - kMargin || box->y + box->height <= kMargin ||
      box->y >= image.height - kMargin)
    throw DataError("{}: its box lies within {} pixels of the border, where SSIM has no window", pair.image.string(),
                    kMargin);
  if (config.offset_outside_box && box->width == image.width && box->height == image.height)
    throw DataError("{}: its box is the whole image, so no offset can be fitted outside", pair.image.string());
  return box;
}

std::vector<MetricsRow> measure_pair(const ImagePair& pair, const ImageMetrics& config) {
  // Grey images become three equal channels, which does not change any mean.
  ByteImage image = read_png(pair.image, 3);
  const ByteImage reference = read_png(pair.reference, 3);
  if (image.width != reference.width || image.height != reference.height) {
    throw DataError("{} is {} x {} pixels, {} is {} x {}", pair.image.string(), image.width, image.height,
                    pair.reference.string(), reference.width, reference.height);
  }
  if (std::min(image.width, image.height) < kLeastSide) {
    throw DataError("{}: is {} x {} pixels, SSIM needs {} each way", pair.image.string(), image.width, image.height,
                    kLeastSide);
  }
  const Box* box = checked_box(image, pair, config);
  if (config.offset_outside_box) image = offset_to(image, reference, *box);
  std::vector<MetricsRow> rows{compare(image, reference, pair, "full")};
  if (const auto& crop = config.crop_px) {
    check_inside(*crop, image, pair, "crop_px");
    rows.push_back(compare(cropped(image, *crop), cropped(reference, *crop), pair, "crop"));
  }
  if (box) rows.push_back(compare_in_box(image, reference, *box, pair));
  return rows;
}

FloatImage read_depth(const std::filesystem::path& file) { return read_exr(file, {"Y"}); }

FloatImage read_depth_like(const std::filesystem::path& file, const FloatImage& rest) {
  FloatImage map = read_depth(file);
  if (map.width != rest.width || map.height != rest.height)
    throw DataError("{}: is {} x {} pixels, the gel at rest {} x {}", file.string(), map.width, map.height, rest.width,
                    rest.height);
  return map;
}

}  // namespace

std::vector<MetricsRow> measure_images(const std::vector<ImagePair>& pairs, const ImageMetrics& config) {
  return measure_pairs(pairs, [&](const ImagePair& pair) { return measure_pair(pair, config); });
}

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
