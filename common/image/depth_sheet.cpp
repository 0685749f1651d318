#include "common/image/depth_sheet.h"

#include <algorithm>

#include "common/image/picture.h"

namespace tacipc {
namespace {

constexpr int kGap = 4;

void paste(const ByteImage& picture, int left, int top, ByteImage& sheet) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c) sheet.at(left + x, top + y, c) = picture.at(x, y, c);
}

}  // namespace

ByteImage depth_sheet(const std::vector<DepthRow>& rows) {
  const int width = rows.front().image.width + kGap, height = rows.front().image.height + kGap;
  float deepest = 1e-6F;
  for (const DepthRow& row : rows)
    for (const float depth : row.truth_mm.pixels)
      if (depth > deepest) deepest = depth;  // NaN is not
  ByteImage sheet(4 * width - kGap, static_cast<int>(rows.size()) * height - kGap, 3, 255);
  int top = 0;
  for (const DepthRow& row : rows) {
    FloatImage error = row.depth_mm;
    for (std::size_t i = 0; i < error.pixels.size(); ++i) error.pixels[i] -= row.truth_mm.pixels[i];
    paste(row.image, 0, top, sheet);
    paste(picture_of_scalar(row.truth_mm, 0.0, deepest), width, top, sheet);
    paste(picture_of_scalar(row.depth_mm, 0.0, deepest), 2 * width, top, sheet);
    paste(picture_of_scalar(error, -0.25 * deepest, 0.25 * deepest), 3 * width, top, sheet);
    top += height;
  }
  return sheet;
}

}  // namespace tacipc
