#include "common/image/depth_sheet.h"

#include <algorithm>

#include "common/image/picture.h"

namespace tacipc {
namespace {

constexpr int kGap = 4, kWidest = 200;  // pixels

/// Means over squares of `by` pixels, of those there are at the border.
ByteImage reduced(const ByteImage& picture, int by) {
  ByteImage out((picture.width + by - 1) / by, (picture.height + by - 1) / by, 3);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < 3; ++c) {
        int sum = 0, count = 0;
        for (int j = by * y; j < std::min(by * (y + 1), picture.height); ++j)
          for (int i = by * x; i < std::min(by * (x + 1), picture.width); ++i, ++count) sum += picture.at(i, j, c);
        out.at(x, y, c) = static_cast<std::uint8_t>((sum + count / 2) / count);
      }
  return out;
}

void paste(const ByteImage& picture, int left, int top, ByteImage& sheet) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c) sheet.at(left + x, top + y, c) = picture.at(x, y, c);
}

}  // namespace

ByteImage depth_sheet(const std::vector<DepthRow>& rows) {
  const ByteImage& first = rows.front().image;
  const int by = (first.width + kWidest - 1) / kWidest;
  const int width = (first.width + by - 1) / by + kGap, height = (first.height + by - 1) / by + kGap;
  float deepest = 1e-6F;
  for (const DepthRow& row : rows)
    for (const float depth : row.truth_mm.pixels)
      if (depth > deepest) deepest = depth;  // NaN is not
  ByteImage sheet(4 * width - kGap, static_cast<int>(rows.size()) * height - kGap, 3, 255);
  int top = 0;
  for (const DepthRow& row : rows) {
    FloatImage error = row.depth_mm;
    for (std::size_t i = 0; i < error.pixels.size(); ++i) error.pixels[i] -= row.truth_mm.pixels[i];
    int left = 0;
    for (const ByteImage& picture :
         {row.image, picture_of_scalar(row.truth_mm, 0.0, deepest), picture_of_scalar(row.depth_mm, 0.0, deepest),
          picture_of_scalar(error, -0.25 * deepest, 0.25 * deepest)}) {
      paste(reduced(picture, by), left, top, sheet);
      left += width;
    }
    top += height;
  }
  return sheet;
}

}  // namespace tacipc
