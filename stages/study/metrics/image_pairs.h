// Which image is compared with which.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tacipc {

struct ImagePair {
  std::string name;  // of the row in samples.csv
  std::filesystem::path image;
  std::filesystem::path reference;
  std::filesystem::path surface = {};  // depth map of the object's, where it is given
};

/// Two folders: files with the same relative name, in name order; only names that end with `ends_with` and have no
/// hidden part count. Two lists of files: in the order given, named by their path below the folder that all images have
/// in common. \throw UsageError for a folder among files or lists of different length, DataError if a file of one
/// folder is missing in the other or none counts.
std::vector<ImagePair> pair_images(const std::vector<std::filesystem::path>& images,
                                   const std::vector<std::filesystem::path>& references, const std::string& ends_with);

}  // namespace tacipc
