#include "stages/dataset/report/contact_sheet.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "stages/dataset/report/html.h"
#include "stages/dataset/report/lettering.h"
#include "stages/dataset/report/scaled_picture.h"

namespace tacipc {
namespace {

constexpr Color kPaper{243, 244, 247}, kCard{255, 255, 255}, kLine{218, 223, 230}, kInk{27, 35, 48};
constexpr Color kQuiet{93, 104, 120}, kGood{21, 112, 60}, kBad{163, 35, 27}, kBadPaper{253, 234, 232};

cv::Scalar scalar(const Color& color) { return {color[0], color[1], color[2]}; }

/// Scales the picture into the box, keeping its proportions.
void draw_picture(cv::Mat& sheet, const ByteImage& image, const cv::Rect& box) {
  ByteImage copy = fitted_picture(image, box.width, box.height);
  const cv::Mat scaled(copy.height, copy.width, CV_8UC3, copy.pixels.data());
  scaled.copyTo(
      sheet({box.x + (box.width - copy.width) / 2, box.y + (box.height - copy.height) / 2, copy.width, copy.height}));
}

/// Breaks at spaces so that each line fits; words that are too long are shortened. At most `max_lines`.
std::vector<Text> wrapped(const std::string& words, const Text& like, int width, std::size_t max_lines) {
  std::vector<Text> lines;
  Text line = like;
  line.words.clear();
  const std::string plain = ascii(words) + " ";
  for (std::size_t at = 0; at < plain.size();) {
    const std::size_t end = plain.find(' ', at);
    Text longer = line;
    if (!line.words.empty()) longer.words += ' ';
    longer.words += plain.substr(at, end - at);
    if (!line.words.empty() && longer.width() > width) {
      if (lines.size() + 1 == max_lines) return lines.push_back(fitted(longer, width)), lines;
      lines.push_back(line);
      longer.words = plain.substr(at, end - at);
    }
    line = fitted(longer, width);
    at = end + 1;
  }
  lines.push_back(line);
  return lines;
}

void draw_cell(cv::Mat& sheet, const SheetLayout& layout, int index, const SampleReport& sample) {
  constexpr int kPadding = SheetLayout::kPadding, kCellHeader = SheetLayout::kCellHeader, kGap = SheetLayout::kGap;
  const cv::Rect cell(layout.cell_x(index), layout.cell_y(index), layout.cell_width, layout.cell_height);
  cv::rectangle(sheet, cell, scalar(kCard), cv::FILLED);
  cv::rectangle(sheet, cell, scalar(kLine), 1);
  const int baseline = cell.y + kPadding + 20;
  const Text verdict{sample.passed() ? "passed" : "FAILED", 12, sample.passed() ? kGood : kBad, true};
  const int verdict_x = cell.x + cell.width - kPadding - verdict.width();
  draw_text(sheet, verdict, verdict_x, baseline);
  int right = verdict_x;
  if (sample.press_force_n) {
    const Text force{number_text(sample.press_force_n) + " N", 12, kQuiet};
    right -= force.width() + 3 * kPadding / 2;
    draw_text(sheet, force, right, baseline);
  }
  const int left = cell.x + kPadding;
  draw_text(sheet, fitted({sample.name, 14, kInk, true}, right - left - kPadding), left, baseline);

  const int y = cell.y + kPadding + kCellHeader - kGap;
  if (!sample.images) {
    const cv::Rect area(left, y, cell.width - 2 * kPadding, layout.picture_height);
    cv::rectangle(sheet, area, scalar(kBadPaper), cv::FILLED);
    int line_y = area.y + 40;
    const auto room = static_cast<std::size_t>((area.height - 40) / 26);
    for (const Text& line : wrapped(sample.failure.value_or("no images"), {"", 12, kBad}, area.width - 40, room)) {
      draw_text(sheet, line, area.x + 20, line_y);
      line_y += 26;
    }
    return;
  }
  int x = left;
  for (const std::optional<std::filesystem::path>& path :
       {std::optional(sample.images->tactile), sample.images->indentation, sample.images->normal}) {
    if (path) draw_picture(sheet, read_picture(*path), {x, y, layout.picture_width, layout.picture_height});
    x += layout.picture_width + kGap;
  }
}

}  // namespace

SheetLayout SheetLayout::for_samples(int count) {
  SheetLayout layout;
  layout.columns = count == 1 ? 1 : count <= 4 ? 2 : 3;
  layout.rows = (count + layout.columns - 1) / layout.columns;
  layout.picture_width = layout.columns == 1 ? 480 : layout.columns == 2 ? 360 : 232;
  layout.picture_height = layout.picture_width * 3 / 4;
  layout.cell_width = 3 * layout.picture_width + 2 * kGap + 2 * kPadding;
  layout.cell_height = layout.picture_height + kCellHeader - kGap + 2 * kPadding;
  layout.width = kMargin + layout.columns * (layout.cell_width + kMargin);
  layout.height = kHeader + layout.rows * (layout.cell_height + kMargin);
  return layout;
}

ByteImage contact_sheet(const std::string& title, const std::vector<SampleReport>& samples) {
  const SheetLayout layout = SheetLayout::for_samples(static_cast<int>(samples.size()));
  ByteImage image(layout.width, layout.height, 3);
  cv::Mat sheet(layout.height, layout.width, CV_8UC3, image.pixels.data());
  sheet.setTo(scalar(kPaper));
  const auto passed = std::count_if(samples.begin(), samples.end(), [](const auto& s) { return s.passed(); });
  const Text tally = {fmt::format("{} of {} passed", passed, samples.size()), 14, kQuiet};
  const int tally_x = layout.width - SheetLayout::kMargin - tally.width(), baseline = SheetLayout::kHeader - 36;
  draw_text(sheet, tally, tally_x, baseline);
  draw_text(sheet, fitted({title, 24, kInk, true}, tally_x - 2 * SheetLayout::kMargin), SheetLayout::kMargin, baseline);
  for (std::size_t i = 0; i < samples.size(); ++i) draw_cell(sheet, layout, static_cast<int>(i), samples[i]);
  return image;
}

}  // namespace tacipc
