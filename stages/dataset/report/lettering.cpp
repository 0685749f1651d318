#include "stages/dataset/report/lettering.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace tacipc {
namespace {

constexpr int kOversampling = 4;  // drawn larger and averaged, strokes of a stroke font become smooth

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

void draw_text(cv::Mat& sheet, const Text& text, int x, int baseline) {
  const int margin = text.height;
  const cv::Size size(text.width() + 2 * margin, 3 * text.height);
  cv::Mat large = cv::Mat::zeros(size * kOversampling, CV_8UC1), mask;
  cv::putText(large, text.words, {kOversampling * margin, kOversampling * 2 * text.height}, cv::FONT_HERSHEY_SIMPLEX,
              font_scale(text.height), 255, text.stroke(), cv::LINE_AA);
  cv::resize(large, mask, size, 0, 0, cv::INTER_AREA);
  const cv::Rect place = cv::Rect(x - margin, baseline - 2 * text.height, size.width, size.height);
  const cv::Rect inside = place & cv::Rect(0, 0, sheet.cols, sheet.rows);
  for (int row = inside.y; row < inside.y + inside.height; ++row) {
    for (int column = inside.x; column < inside.x + inside.width; ++column) {
      const double part = mask.at<unsigned char>(row - place.y, column - place.x) / 255.0;
      auto& pixel = sheet.at<cv::Vec3b>(row, column);
      for (int c = 0; c < 3; ++c) {
        pixel[c] = static_cast<unsigned char>(
            std::lround((1.0 - part) * pixel[c] + part * text.color[static_cast<std::size_t>(c)]));
      }
    }
  }
}

}  // namespace tacipc
