#include "stages/metrics/metrics_table.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <exception>
#include <iterator>

#include "common/csv.h"
#include "common/error.h"
#include "common/mean_deviation.h"
#include "stages/metrics/image_error.h"
#include "stages/metrics/sharpness.h"
#include "stages/metrics/ssim.h"

namespace tacipc {
namespace {

struct Column {
  const char* name;
  double MetricsRow::*value;
};

constexpr std::array kColumns = {Column{"mae", &MetricsRow::mae},
                                 Column{"mse", &MetricsRow::mse},
                                 Column{"psnr_db", &MetricsRow::psnr_db},
                                 Column{"psnr_ln", &MetricsRow::psnr_ln},
                                 Column{"ssim_w", &MetricsRow::ssim_w},
                                 Column{"ssim_s", &MetricsRow::ssim_s},
                                 Column{"sharpness", &MetricsRow::sharpness}};

ByteImage cropped(const ByteImage& image, const Box& box) {
  ByteImage out(box.width, box.height, image.channels);
  const auto width = static_cast<std::size_t>(box.width * image.channels);
  for (int y = 0; y < box.height; ++y) std::copy_n(&image.at(box.x, box.y + y, 0), width, &out.at(0, y, 0));
  return out;
}

MetricsRow compare(const ByteImage& image, const ByteImage& reference, std::string name, std::string region) {
  const ImageError error = image_error(image, reference);
  return {.name = std::move(name),
          .region = std::move(region),
          .mae = error.mae,
          .mse = error.mse,
          .psnr_db = psnr_db(error.mse),
          .psnr_ln = psnr_ln(error.mse),
          .ssim_w = ssim(image, reference, gaussian_window()),
          .ssim_s = ssim(image, reference, box_window()),
          .sharpness = sharpness(image, reference, {0, 0, image.width, image.height})};
}

/// Errors of the box's pixels, SSIM and sharpness of the whole image's maps there.
MetricsRow compare_in_box(const ByteImage& image, const ByteImage& reference, const Box& box, std::string name) {
  const ImageError error = image_error(cropped(image, box), cropped(reference, box));
  return {.name = std::move(name),
          .region = "box",
          .mae = error.mae,
          .mse = error.mse,
          .psnr_db = psnr_db(error.mse),
          .psnr_ln = psnr_ln(error.mse),
          .ssim_w = ssim_in_box(image, reference, gaussian_window(), box),
          .ssim_s = ssim_in_box(image, reference, box_window(), box),
          .sharpness = sharpness(image, reference, box)};
}

void check_inside(const Box& box, const ByteImage& image, const ImagePair& pair, const char* key) {
  if (box.x + box.width <= image.width && box.y + box.height <= image.height) return;
  throw DataError("{}: is {} x {} pixels, {} reaches to {} x {}", pair.image.string(), image.width, image.height, key,
                  box.x + box.width, box.y + box.height);
}

/// The image's box, if any is configured. \throw DataError if it does not fit, has no pixel with a whole window, or
/// leaves no pixel outside although an offset is to be fitted there.
const Box* checked_box(const ByteImage& image, const ImagePair& pair, const MetricsConfig& config) {
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

std::vector<MetricsRow> measure_pair(const ImagePair& pair, const MetricsConfig& config) {
  // Grey images become three equal channels, which changes no mean.
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
  if (config.offset_outside_box)
    image = offset_to(image, reference, box->x, box->y, box->x + box->width, box->y + box->height);
  std::vector<MetricsRow> rows{compare(image, reference, pair.name, "full")};
  if (const auto& crop = config.crop_px) {
    check_inside(*crop, image, pair, "crop_px");
    rows.push_back(compare(cropped(image, *crop), cropped(reference, *crop), pair.name, "crop"));
  }
  if (box) rows.push_back(compare_in_box(image, reference, *box, pair.name));
  return rows;
}

Value::Map lines_of(const MeanDeviation& value) { return {{"mean", value.mean}, {"std", value.deviation}}; }

}  // namespace

std::vector<MetricsRow> measure(const std::vector<ImagePair>& pairs, const MetricsConfig& config) {
  std::vector<std::vector<MetricsRow>> of_pair(pairs.size());
  std::vector<std::exception_ptr> failed(pairs.size());
  tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t i) {
    try {
      of_pair[i] = measure_pair(pairs[i], config);
    } catch (...) {
      failed[i] = std::current_exception();
    }
  });
  // The first failure in the order of the pairs, whichever thread was first.
  for (const std::exception_ptr& failure : failed)
    if (failure) std::rethrow_exception(failure);
  std::vector<MetricsRow> rows;
  for (const auto& some : of_pair) rows.insert(rows.end(), some.begin(), some.end());
  return rows;
}

std::string to_csv(const std::vector<MetricsRow>& rows) {
  std::string text = "name,region";
  for (const Column& column : kColumns) text += fmt::format(",{}", column.name);
  text += '\n';
  for (const MetricsRow& row : rows) {
    std::vector<std::string> fields{row.name, row.region};
    for (const Column& column : kColumns) fields.push_back(fmt::format("{}", row.*column.value));
    text += csv_line(fields);
  }
  return text;
}

Value::Map summary_of(const std::vector<MetricsRow>& rows) {
  Value::Map summary;
  for (const char* region : {"full", "crop", "box"}) {
    std::vector<MetricsRow> some;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(some),
                 [&](const MetricsRow& row) { return row.region == region; });
    if (some.empty()) continue;
    Value::Map means{{"images", some.size()}};
    double mse = 0.0;
    for (const MetricsRow& row : some) mse += row.mse / static_cast<double>(some.size());
    for (const Column& column : kColumns) {
      std::vector<double> values;
      for (const MetricsRow& row : some) values.push_back(row.*column.value);
      means.emplace_back(column.name, lines_of(mean_and_deviation(values)));
    }
    means.emplace_back("psnr_db_of_mean_mse", psnr_db(mse));
    summary.emplace_back(region, std::move(means));
  }
  return summary;
}

}  // namespace tacipc
