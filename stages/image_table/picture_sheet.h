// Pictures of several methods side by side, a row per image.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/image.h"
#include "stages/image_table/image_table_config.h"

namespace tacipc {

/// The pictures of each column, in the order they were given: of the folders on a picture's path, the deepest that is a
/// column's tells which. Pictures of no column are left out.
/// \throw DataError if columns have different numbers of pictures
std::vector<std::vector<std::filesystem::path>> pictures_of_columns(const std::vector<std::filesystem::path>& pictures,
                                                                    const SheetConfig& config);

/// Cropped, scaled to `picture_px` wide, white between; headings above the columns (characters outside ASCII as '?'),
/// and each row's name, the file's, at its left edge. \throw DataError if a picture cannot be read or the crop leaves
/// it
ByteImage picture_sheet(const std::vector<std::vector<std::filesystem::path>>& columns, const SheetConfig& config);

}  // namespace tacipc
