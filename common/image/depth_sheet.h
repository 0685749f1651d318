// A sheet of pictures that compares a network's depth with the truth.
#pragma once

#include <vector>

#include "common/image/image.h"

namespace tacipc {

/// One row of the sheet.
struct DepthRow {
  ByteImage image;
  FloatImage truth_mm;
  FloatImage depth_mm;
};

/// Draws a row each: image, truth, predicted depth, and their difference from −¼ to +¼ of the largest true depth of all
/// rows (dark: too shallow; light: too deep). Depths are coloured from 0 to that largest depth. Pictures wider than 200
/// pixels are reduced.
/// \pre images of one size, at least one
ByteImage depth_sheet(const std::vector<DepthRow>& rows);

}  // namespace tacipc
