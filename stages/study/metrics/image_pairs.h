// Pairs each image with its reference.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tacipc {

/// An image and its reference.
struct ImagePair {
  std::string name;  // name of the row in samples.csv
  std::filesystem::path image;
  std::filesystem::path reference;
  std::filesystem::path surface = {};  // depth map of the object's surface, if given
};

/// Pairs images and references. Two folders: files with the same relative name, in name order; names count if they end
/// with `ends_with` and have no hidden part. Two lists of files: in the given order, named by their path below the
/// common folder of all images.
/// \throw UsageError for a folder among files or lists of different length
/// \throw DataError if a file of one folder is missing in the other, or no name counts
std::vector<ImagePair> pair_images(const std::vector<std::filesystem::path>& images,
                                   const std::vector<std::filesystem::path>& references, const std::string& ends_with);

}  // namespace tacipc
