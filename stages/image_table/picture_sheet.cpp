#include "stages/image_table/picture_sheet.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "common/error.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

constexpr int kGap = 4, kHeadingHeight = 18, kLetterHeight = 9;
constexpr int kOversampling = 4;  // letters are drawn larger and averaged

/// Number of the column that a picture belongs to.
std::optional<std::size_t> column_of(const fs::path& picture, const SheetConfig& config) {
  for (fs::path above = fs::absolute(picture).lexically_normal().parent_path(); above.has_relative_path();
       above = above.parent_path())
    for (std::size_t c = 0; c < config.columns.size(); ++c)
      if (above.filename() == config.columns[c].folder) return c;
  return std::nullopt;
}

/// A picture, cropped and scaled.
cv::Mat picture(const fs::path& path, const SheetConfig& config) {
  ByteImage image = read_png(path, 3);
  cv::Mat whole(image.height, image.width, CV_8UC3, image.pixels.data());
  if (const auto& crop = config.crop_px) {
    const auto& [x, y, width, height] = *crop;
    if (x + width > image.width || y + height > image.height)
      throw DataError("{}: is {} x {} pixels, crop_px reaches to {} x {}", path.string(), image.width, image.height,
                      x + width, y + height);
    whole = whole(cv::Rect(x, y, width, height));
  }
  const double scale = static_cast<double>(config.picture_px) / whole.cols;
  cv::Mat scaled;
  cv::resize(whole, scaled, {config.picture_px, std::max(1, static_cast<int>(std::lround(scale * whole.rows)))}, 0, 0,
             scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return scaled;
}

/// Words in black on white, `width` pixels wide and high as a heading; smaller where they would not fit.
cv::Mat words(const std::string& text, int width) {
  std::string ascii;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x80 || code >= 0xc0) ascii += code >= 0x20 && code < 0x7f ? c : '?';
  }
  double scale = kOversampling * kLetterHeight / 22.0;
  int baseline = 0;
  const cv::Size full = cv::getTextSize(ascii, cv::FONT_HERSHEY_SIMPLEX, scale, kOversampling, &baseline);
  scale *= std::min(1.0, static_cast<double>(kOversampling * (width - 2)) / std::max(1, full.width));
  cv::Mat large(kOversampling * kHeadingHeight, kOversampling * width, CV_8UC3, cv::Scalar(255, 255, 255)), small;
  cv::putText(large, ascii, {kOversampling, kOversampling * (kHeadingHeight - 5)}, cv::FONT_HERSHEY_SIMPLEX, scale,
              cv::Scalar(0, 0, 0), kOversampling, cv::LINE_AA);
  cv::resize(large, small, {width, kHeadingHeight}, 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace

std::vector<std::vector<fs::path>> pictures_of_columns(const std::vector<fs::path>& pictures,
                                                       const SheetConfig& config) {
  std::vector<std::vector<fs::path>> columns(config.columns.size());
  for (const fs::path& path : pictures)
    if (const auto column = column_of(path, config)) columns[*column].push_back(path);
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c].empty() || columns[c].size() != columns.front().size())
      throw DataError("sheet {}: {} pictures below {}, {} below {}", config.name, columns.front().size(),
                      config.columns.front().folder, columns[c].size(), config.columns[c].folder);
  return columns;
}

ByteImage picture_sheet(const std::vector<std::vector<fs::path>>& columns, const SheetConfig& config) {
  std::vector<std::vector<cv::Mat>> rows;
  int height = kGap + kHeadingHeight;
  for (std::size_t r = 0; r < columns.front().size(); ++r) {
    std::vector<cv::Mat> row;
    int tallest = 0;
    for (const auto& column : columns) {
      row.push_back(picture(column[r], config));
      tallest = std::max(tallest, row.back().rows);
    }
    height += kHeadingHeight + tallest + kGap;
    rows.push_back(std::move(row));
  }
  const int step = config.picture_px + kGap;
  ByteImage out(kGap + static_cast<int>(columns.size()) * step, height, 3, 255);
  cv::Mat sheet(out.height, out.width, CV_8UC3, out.pixels.data());
  int top = kGap;
  for (std::size_t c = 0; c < columns.size(); ++c)
    words(config.columns[c].heading, config.picture_px)
        .copyTo(sheet({kGap + static_cast<int>(c) * step, top, config.picture_px, kHeadingHeight}));
  top += kHeadingHeight;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    words(columns.front()[r].stem().string(), out.width - 2 * kGap)
        .copyTo(sheet({kGap, top, out.width - 2 * kGap, kHeadingHeight}));
    top += kHeadingHeight;
    int tallest = 0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const cv::Mat& image = rows[r][c];
      image.copyTo(sheet({kGap + static_cast<int>(c) * step, top, image.cols, image.rows}));
      tallest = std::max(tallest, image.rows);
    }
    top += tallest + kGap;
  }
  return out;
}

}  // namespace tacipc
