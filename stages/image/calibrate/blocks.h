// Reduces an image to one value per block of pixels.
#pragma once

#include <vector>

#include "common/image/image.h"

namespace tacipc {

/// Image of reduce(values of a channel in the block) for each whole block of `block` × `block` pixels; a remainder at
/// the right and lower border is left out.
template <typename Pixel, typename Reduce>
FloatImage reduced_blocks(const Image<Pixel>& image, int block, Reduce&& reduce) {
  FloatImage out(image.width / block, image.height / block, image.channels);
  std::vector<Pixel> values;
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < image.channels; ++c) {
        values.clear();
        for (int v = 0; v < block; ++v)
          for (int u = 0; u < block; ++u) values.push_back(image.at(x * block + u, y * block + v, c));
        out.at(x, y, c) = reduce(values);
      }
  return out;
}

/// Midmean of each block of `block` × `block` pixels and channel: the mean over the middle half of the sorted grey
/// levels. Dust, scratches and single markers drop out as with the median, but noise averages out below one level. NaN
/// if one of these levels is 0 or 255, which means clipped.
/// \pre block divides width and height
FloatImage block_codes(const ByteImage& image, int block);

}  // namespace tacipc
