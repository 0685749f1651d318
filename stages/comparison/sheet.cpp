#include "stages/comparison/sheet.h"

#include <algorithm>

namespace tacipc {
namespace {

constexpr int kAround = 20, kGap = 4, kColumns = 4;

struct Window {
  int left, top, width, height;
};

Window window_of(const SheetRow& row) {
  const auto& [x, y, w, h] = row.box_px;
  const int left = std::max(0, x - kAround), top = std::max(0, y - kAround);
  return {left, top, std::min(row.real.width, x + w + kAround) - left,
          std::min(row.real.height, y + h + kAround) - top};
}

}  // namespace

ByteImage sheet(const std::vector<SheetRow>& rows) {
  int width = 0, height = kGap;
  for (const SheetRow& row : rows) {
    const Window window = window_of(row);
    width = std::max(width, kGap + kColumns * (window.width + kGap));
    height += window.height + kGap;
  }
  ByteImage out(width, height, 3, 255);
  int top = kGap;
  for (const SheetRow& row : rows) {
    const Window window = window_of(row);
    for (int y = 0; y < window.height; ++y)
      for (int x = 0; x < window.width; ++x)
        for (int c = 0; c < 3; ++c) {
          const int u = window.left + x, v = window.top + y;
          const std::uint8_t real = row.real.at(u, v, c), ours = row.ours.at(u, v, c), rival = row.rival.at(u, v, c);
          const auto difference = static_cast<std::uint8_t>(std::clamp(128 + 2 * (int{ours} - int{real}), 0, 255));
          int left = kGap;
          for (const std::uint8_t code : {real, ours, difference, rival}) {
            out.at(left + x, top + y, c) = code;
            left += window.width + kGap;
          }
        }
    top += window.height + kGap;
  }
  return out;
}

}  // namespace tacipc
