// Pictures of several methods side by side, a row per image.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "common/benchmark/benchmark_cases.h"
#include "common/image/image.h"
#include "common/stage/named_path.h"
#include "stages/study/tabulate/image_table_config.h"

namespace tacipc {

/// The pictures of a method, in the order given.
std::vector<std::filesystem::path> pictures_of(const std::vector<NamedPath>& pictures, const std::string& method);

/// The pictures of each column, in the order they were given by the name of its method. Those of methods that are no
/// column are left out: another sheet may show them.
/// \throw DataError if columns have different numbers of pictures, or none
std::vector<std::vector<std::filesystem::path>> pictures_of_columns(const std::vector<NamedPath>& pictures,
                                                                    const SheetConfig& config);

/// Cropped, scaled to `picture_px` wide, white between; headings above the columns (characters outside ASCII as '?'),
/// and each row's name, the file's, at its left edge. \throw DataError if a picture cannot be read or the crop leaves
/// it
ByteImage picture_sheet(const std::vector<std::vector<std::filesystem::path>>& columns, const SheetConfig& config);

/// A photograph, what two methods make of it, and where the contact is. Images of equal size.
struct ComparedPicture {
  ByteImage real;
  ByteImage ours;
  ByteImage rival;
  std::array<int, 4> box_px{};
};

/// Pictures of the methods `photograph`, `ours` and `rival`, each in the order of the benchmark's images.
/// \throw UsageError if a method has not one of each image; DataError if one is not of its photograph's size, or a
/// contact box leaves it
std::vector<ComparedPicture> compared_pictures(const std::vector<NamedPath>& pictures, const std::string& ours,
                                               const std::string& rival, const BenchmarkCases& cases);

/// Columns: photograph, ours, twice their difference about grey, the rival; each the contact box with 20 pixels around
/// it, as far as the image goes. White between.
ByteImage difference_sheet(const std::vector<ComparedPicture>& rows);

}  // namespace tacipc
