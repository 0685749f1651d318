// A picture of what a network makes of images: for people.
#pragma once

#include <vector>

#include "common/image/image.h"

namespace tacipc {

/// A row of the sheet.
struct DepthRow {
  ByteImage image;
  FloatImage truth_mm;
  FloatImage depth_mm;
};

/// A row each: image, truth, what the network says, and their difference from −¼ to +¼ of the greatest truth of all
/// rows (dark: too shallow; light: too deep). Depths from 0 to that. Pictures wider than 200 pixels are reduced.
/// \pre images of one size, at least one
ByteImage depth_sheet(const std::vector<DepthRow>& rows);

}  // namespace tacipc
