#include "common/image/depth_sheet.h"

#include "common/image/picture.h"

namespace tacipc {
namespace {

constexpr int kGap = 4, kWidest = 200;  // pixels

}  // namespace

ByteImage depth_sheet(const std::vector<DepthRow>& rows) {
  const ByteImage& first = rows.front().image;
  const int by = (first.width + kWidest - 1) / kWidest;
  const int width = (first.width + by - 1) / by + kGap, height = (first.height + by - 1) / by + kGap;
  float deepest = 1e-6F;
  for (const DepthRow& row : rows)
    for (const float depth : row.truth_mm.pixels)
      if (depth > deepest) deepest = depth;  // false for NaN
  ByteImage sheet(4 * width - kGap, static_cast<int>(rows.size()) * height - kGap, 3, 255);
  int top = 0;
  for (const DepthRow& row : rows) {
    FloatImage error = row.depth_mm;
    for (std::size_t i = 0; i < error.pixels.size(); ++i) error.pixels[i] -= row.truth_mm.pixels[i];
    int left = 0;
    for (const ByteImage& picture :
         {row.image, picture_of_scalar(row.truth_mm, 0.0, deepest), picture_of_scalar(row.depth_mm, 0.0, deepest),
          picture_of_scalar(error, -0.25 * deepest, 0.25 * deepest)}) {
      paste(sheet, reduced(picture, by), left, top);
      left += width;
    }
    top += height;
  }
  return sheet;
}

}  // namespace tacipc
