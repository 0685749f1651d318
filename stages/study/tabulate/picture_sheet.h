// Puts pictures of several methods next to each other, a row per image.
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

/// Pictures of a method, in the given order.
std::vector<std::filesystem::path> pictures_of(const std::vector<NamedPath>& pictures, const std::string& method);

/// Pictures of each column, in the order in which they were given for its method. Methods without a column are left
/// out, because another sheet may show them.
/// \throw DataError if columns have different numbers of pictures, or none
std::vector<std::vector<std::filesystem::path>> pictures_of_columns(const std::vector<NamedPath>& pictures,
                                                                    const SheetConfig& config);

/// The sheet: pictures cropped, scaled to `picture_px` wide, white between them. Headings stand above the columns
/// (characters outside ASCII as '?'), and each row's file name at its left edge.
/// \throw DataError if a picture cannot be read or the crop leaves it
ByteImage picture_sheet(const std::vector<std::vector<std::filesystem::path>>& columns, const SheetConfig& config);

/// A photograph, the images of two methods, and the contact box. All images have equal size.
struct ComparedPicture {
  ByteImage real;
  ByteImage ours;
  ByteImage rival;
  std::array<int, 4> box_px{};
};

/// Pictures of the methods `photograph`, `ours` and `rival`, each in the order of the benchmark's images.
/// \throw UsageError if a method lacks an image or has one twice
/// \throw DataError if a picture's size differs from its photograph, or a contact box leaves it
std::vector<ComparedPicture> compared_pictures(const std::vector<NamedPath>& pictures, const std::string& ours,
                                               const std::string& rival, const BenchmarkCases& cases);

/// Sheet with the columns photograph, TacIPC, twice their difference around grey, other simulator. Each shows the
/// contact box and up to 20 pixels around it, with white between.
ByteImage difference_sheet(const std::vector<ComparedPicture>& rows);

}  // namespace tacipc
