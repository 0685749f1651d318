#include "stages/dataset/report/contact_sheet.h"

#include <fmt/core.h>

#include <algorithm>

#include "stages/dataset/report/html.h"
#include "stages/dataset/report/sheet.h"

namespace tacipc {
namespace {

constexpr Color kPaper{243, 244, 247}, kCard{255, 255, 255}, kLine{218, 223, 230}, kInk{27, 35, 48};
constexpr Color kQuiet{93, 104, 120}, kGood{21, 112, 60}, kBad{163, 35, 27}, kBadPaper{253, 234, 232};

/// Breaks text at spaces so that each line fits; words that are too long are shortened. At most `max_lines`.
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

void draw_cell(ByteImage& sheet, const SheetLayout& layout, int index, const SampleReport& sample) {
  constexpr int kPadding = SheetLayout::kPadding, kCellHeader = SheetLayout::kCellHeader, kGap = SheetLayout::kGap;
  const int cell_x = layout.cell_x(index), cell_y = layout.cell_y(index);
  fill_box(sheet, cell_x, cell_y, layout.cell_width, layout.cell_height, kLine);
  fill_box(sheet, cell_x + 1, cell_y + 1, layout.cell_width - 2, layout.cell_height - 2, kCard);
  const int baseline = cell_y + kPadding + 20;
  const Text verdict{sample.passed() ? "passed" : "FAILED", 12, sample.passed() ? kGood : kBad, true};
  const int verdict_x = cell_x + layout.cell_width - kPadding - verdict.width();
  draw_text(sheet, verdict, verdict_x, baseline);
  int right = verdict_x;
  if (sample.press_force_n) {
    const Text force{number_text(sample.press_force_n) + " N", 12, kQuiet};
    right -= force.width() + 3 * kPadding / 2;
    draw_text(sheet, force, right, baseline);
  }
  const int left = cell_x + kPadding;
  draw_text(sheet, fitted({sample.name, 14, kInk, true}, right - left - kPadding), left, baseline);

  const int y = cell_y + kPadding + kCellHeader - kGap;
  if (!sample.images) {
    const int width = layout.cell_width - 2 * kPadding;
    fill_box(sheet, left, y, width, layout.picture_height, kBadPaper);
    int line_y = y + 40;
    const auto room = static_cast<std::size_t>((layout.picture_height - 40) / 26);
    for (const Text& line : wrapped(sample.failure.value_or("no images"), {"", 12, kBad}, width - 40, room)) {
      draw_text(sheet, line, left + 20, line_y);
      line_y += 26;
    }
    return;
  }
  int x = left;
  for (const std::optional<std::filesystem::path>& path :
       {std::optional(sample.images->tactile), sample.images->indentation, sample.images->normal}) {
    if (path) {
      const ByteImage copy = fitted_picture(read_picture(*path), layout.picture_width, layout.picture_height);
      paste(sheet, copy, x + (layout.picture_width - copy.width) / 2, y + (layout.picture_height - copy.height) / 2);
    }
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
  ByteImage sheet(layout.width, layout.height, 3);
  fill_box(sheet, 0, 0, layout.width, layout.height, kPaper);
  const auto passed = std::count_if(samples.begin(), samples.end(), [](const auto& s) { return s.passed(); });
  const Text tally = {fmt::format("{} of {} passed", passed, samples.size()), 14, kQuiet};
  const int tally_x = layout.width - SheetLayout::kMargin - tally.width(), baseline = SheetLayout::kHeader - 36;
  draw_text(sheet, tally, tally_x, baseline);
  draw_text(sheet, fitted({title, 24, kInk, true}, tally_x - 2 * SheetLayout::kMargin), SheetLayout::kMargin, baseline);
  for (std::size_t i = 0; i < samples.size(); ++i) draw_cell(sheet, layout, static_cast<int>(i), samples[i]);
  return sheet;
}

}  // namespace tacipc
