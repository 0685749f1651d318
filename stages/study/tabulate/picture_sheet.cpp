#include "stages/study/tabulate/picture_sheet.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "common/base/error.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

constexpr int kGap = 4, kHeadingHeight = 18, kLetterHeight = 9;
constexpr int kOversampling = 4;  // letters are drawn larger and averaged

cv::Mat view(const ByteImage& image) {
  return cv::Mat(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels.data()));
}

/// Reads a picture, cropped and scaled.
cv::Mat picture(const fs::path& path, const SheetConfig& config) {
  ByteImage image = read_png(path, 3);
  cv::Mat whole = view(image);
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

/// Text in black on white, `width` pixels wide and as high as a heading; smaller if it would not fit.
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

constexpr int kBorderPx = 20, kComparedColumns = 4;

/// The contact box and its margin, limited to the image.
cv::Rect window_of(const ComparedPicture& row) {
  const auto& [x, y, w, h] = row.box_px;
  return cv::Rect(x - kBorderPx, y - kBorderPx, w + 2 * kBorderPx, h + 2 * kBorderPx) &
         cv::Rect(0, 0, row.real.width, row.real.height);
}

}  // namespace

std::vector<fs::path> pictures_of(const std::vector<NamedPath>& pictures, const std::string& method) {
  std::vector<fs::path> paths;
  for (const auto& [name, path] : pictures)
    if (name == method) paths.push_back(path);
  return paths;
}

std::vector<std::vector<fs::path>> pictures_of_columns(const std::vector<NamedPath>& pictures,
                                                       const SheetConfig& config) {
  std::vector<std::vector<fs::path>> columns;
  for (const SheetColumn& column : config.columns) columns.push_back(pictures_of(pictures, column.method));
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c].empty() || columns[c].size() != columns.front().size())
      throw DataError("sheet {}: {} pictures of {}, {} of {}", config.name, columns.front().size(),
                      config.columns.front().method, columns[c].size(), config.columns[c].method);
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
  cv::Mat sheet = view(out);
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

std::vector<ComparedPicture> compared_pictures(const std::vector<NamedPath>& pictures, const std::string& ours,
                                               const std::string& rival, const BenchmarkCases& cases) {
  std::vector<PhotographCase> images;
  for (const ObjectCase& object : cases.objects)
    images.insert(images.end(), object.images.begin(), object.images.end());
  std::vector<std::vector<fs::path>> paths;
  for (const std::string& method : {std::string("photograph"), ours, rival}) {
    paths.push_back(pictures_of(pictures, method));
    if (paths.back().size() == images.size()) continue;
    throw UsageError(
        fmt::format("--pictures: {} of {}, the benchmark has {} images", paths.back().size(), method, images.size()));
  }
  std::vector<ComparedPicture> rows;
  for (std::size_t i = 0; i < images.size(); ++i) {
    rows.push_back({read_png(paths[0][i], 3), read_png(paths[1][i], 3), read_png(paths[2][i], 3), images[i].box_px});
    const auto& [real, simulated, other, box] = rows.back();
    for (const ByteImage* image : {&simulated, &other})
      if (image->width != real.width || image->height != real.height)
        throw DataError("{}: images are not of the photograph's size", images[i].name);
    if (box[0] + box[2] > real.width || box[1] + box[3] > real.height)
      throw DataError("{}: the contact box leaves the photograph", images[i].name);
  }
  return rows;
}

ByteImage difference_sheet(const std::vector<ComparedPicture>& rows) {
  int width = 0, height = kGap;
  for (const ComparedPicture& row : rows) {
    const cv::Rect window = window_of(row);
    width = std::max(width, kGap + kComparedColumns * (window.width + kGap));
    height += window.height + kGap;
  }
  ByteImage out(width, height, 3, 255);
  int top = kGap;
  for (const ComparedPicture& row : rows) {
    const cv::Rect window = window_of(row);
    cv::Mat difference;
    cv::addWeighted(view(row.ours), 2.0, view(row.real), -2.0, 128.0, difference);
    int left = kGap;
    for (const cv::Mat& picture : {view(row.real), view(row.ours), difference, view(row.rival)}) {
      picture(window).copyTo(view(out)(cv::Rect({left, top}, window.size())));
      left += window.width + kGap;
    }
    top += window.height + kGap;
  }
  return out;
}

}  // namespace tacipc
