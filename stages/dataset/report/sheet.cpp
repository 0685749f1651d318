#include "stages/dataset/report/sheet.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace tacipc {
namespace {

constexpr int kOversampling = 4;  // text is drawn larger and averaged, so that strokes become smooth

/// View of the same pixels as an OpenCV matrix.
cv::Mat mat_of(const ByteImage& image) {
  return {image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels.data())};
}

double font_scale(int height) { return static_cast<double>(kOversampling * height) / 22.0; }

}  // namespace

int Text::stroke() const {
  return std::max(1, static_cast<int>(std::lround(kOversampling * height * (bold ? 0.18 : 0.115))));
}

int Text::width() const {
  int baseline = 0;
  const cv::Size size = cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, font_scale(height), stroke(), &baseline);
  return (size.width + kOversampling - 1) / kOversampling;
}

std::string ascii(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 && code < 0x7f) out += c;
    if (code < 0x20 || code == 0x7f || code >= 0xc0) out += '?';
  }
  return out;
}

Text fitted(Text text, int width) {
  text.words = ascii(text.words);
  if (text.width() <= width) return text;
  std::string whole = text.words;
  do {
    whole.pop_back();
    text.words = whole + "...";
  } while (!whole.empty() && text.width() > width);
  return text;
}

void draw_text(ByteImage& sheet, const Text& text, int x, int baseline) {
  const int margin = text.height;
  const cv::Size size(text.width() + 2 * margin, 3 * text.height);
  cv::Mat large = cv::Mat::zeros(size * kOversampling, CV_8UC1), mask;
  cv::putText(large, text.words, {kOversampling * margin, kOversampling * 2 * text.height}, cv::FONT_HERSHEY_SIMPLEX,
              font_scale(text.height), 255, text.stroke(), cv::LINE_AA);
  cv::resize(large, mask, size, 0, 0, cv::INTER_AREA);
  const cv::Rect place = cv::Rect(x - margin, baseline - 2 * text.height, size.width, size.height);
  const cv::Rect inside = place & cv::Rect(0, 0, sheet.width, sheet.height);
  cv::Mat pixels = mat_of(sheet);
  for (int row = inside.y; row < inside.y + inside.height; ++row) {
    for (int column = inside.x; column < inside.x + inside.width; ++column) {
      const double part = mask.at<unsigned char>(row - place.y, column - place.x) / 255.0;
      auto& pixel = pixels.at<cv::Vec3b>(row, column);
      for (int c = 0; c < 3; ++c) {
        pixel[c] = static_cast<unsigned char>(
            std::lround((1.0 - part) * pixel[c] + part * text.color[static_cast<std::size_t>(c)]));
      }
    }
  }
}

void fill_box(ByteImage& sheet, int x, int y, int width, int height, const Color& color) {
  mat_of(sheet)({x, y, width, height}).setTo(cv::Scalar(color[0], color[1], color[2]));
}

ByteImage fitted_picture(const ByteImage& image, int width, int height) {
  const double scale = std::min(static_cast<double>(width) / image.width, static_cast<double>(height) / image.height);
  ByteImage copy(std::max(1, static_cast<int>(std::lround(scale * image.width))),
                 std::max(1, static_cast<int>(std::lround(scale * image.height))), 3);
  cv::Mat target = mat_of(copy);
  cv::resize(mat_of(image), target, target.size(), 0, 0, scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return copy;
}

}  // namespace tacipc
