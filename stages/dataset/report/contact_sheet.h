// Draws all samples on one picture.
#pragma once

#include <string>
#include <vector>

#include "common/image/image.h"
#include "stages/dataset/report/sample.h"

namespace tacipc {

/// Sizes in pixels, by the number of samples: one large, a few in two columns, many in three.
struct SheetLayout {
  int columns = 1;
  int rows = 1;
  int picture_width = 0;  // each picture fits into a box of 4 : 3
  int picture_height = 0;
  int cell_width = 0;
  int cell_height = 0;
  int width = 0;
  int height = 0;

  static constexpr int kMargin = 28, kGap = 8, kHeader = 96, kCellHeader = 48, kPadding = 14;
  /// \pre at least one sample
  static SheetLayout for_samples(int count);
  int cell_x(int index) const { return kMargin + index % columns * (cell_width + kMargin); }
  int cell_y(int index) const { return kHeader + index / columns * (cell_height + kMargin); }
};

/// Picture with, per sample: name, verdict and press force; tactile image, indentation and normals in a row, or the
/// reason why they are missing. Characters outside ASCII appear as '?'.
/// \throw DataError if a picture cannot be read
ByteImage contact_sheet(const std::string& title, const std::vector<SampleReport>& samples);

}  // namespace tacipc
