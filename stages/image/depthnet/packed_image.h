// Reads an image of a packed sample.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "common/base/error.h"
#include "common/format/hdf5_reader.h"
#include "common/image/image.h"

namespace tacipc {

/// One frame of a packed image.
/// \throw DataError if the field does not have this type and number of channels
template <typename T>
Image<T> packed_image(const Hdf5Reader& shard, const std::string& field, NumberType type, int channels,
                      std::size_t frame) {
  const std::vector<std::size_t> shape = shard.shape(field);
  const bool fits = channels == 1 ? shape.size() == 3 : shape.size() == 4 && shape[3] == 3;
  if (!fits || shard.type(field) != type)
    throw DataError("{}: is not {} in {} channels", field, name_of(type), channels);
  Image<T> image(static_cast<int>(shape[2]), static_cast<int>(shape[1]), channels);
  const std::string bytes = shard.read_frame(field, frame);
  std::memcpy(image.pixels.data(), bytes.data(), std::min(bytes.size(), image.pixels.size() * sizeof(T)));
  return image;
}

}  // namespace tacipc
