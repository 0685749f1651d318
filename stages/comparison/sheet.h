// All photographs and what the methods make of them, side by side.
#pragma once

#include <array>
#include <vector>

#include "common/benchmark_cases.h"
#include "common/image.h"

namespace tacipc {

/// One row of the sheet, images of equal size.
struct SheetRow {
  ByteImage real;
  ByteImage ours;
  ByteImage rival;
  std::array<int, 4> box_px{};
};

/// Columns: photograph, ours, twice their difference about grey, the rival; each the contact box with 20 pixels around
/// it, as far as the image goes. White between.
ByteImage sheet(const std::vector<SheetRow>& rows);

}  // namespace tacipc
