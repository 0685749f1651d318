// Texts of an HDF5 file.
#pragma once

#include <string>
#include <vector>

#include "common/format/hdf5_reader.h"

namespace tacipc {

/// A dataset that Hdf5Writer::write_texts wrote.
inline std::vector<std::string> texts_of(const Hdf5Reader& file, const std::string& dataset) {
  const std::size_t count = file.shape(dataset).at(0);
  const std::string bytes = file.read(dataset);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i)
    texts.emplace_back(bytes.substr(i * bytes.size() / count, bytes.size() / count).c_str());
  return texts;
}

}  // namespace tacipc
