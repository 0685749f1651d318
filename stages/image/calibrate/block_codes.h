// A photograph as few numbers: one code per block and channel.
#pragma once

#include "common/image/image.h"

namespace tacipc {

/// Midmean of each block of `block` × `block` pixels and channel, the mean over the middle half of the sorted codes:
/// dust, scratches and single markers drop out as with the median, but noise averages out below one code. NaN where one
/// of those codes is 0 or 255: clipped. \pre block divides width and height
FloatImage block_codes(const ByteImage& image, int block);

}  // namespace tacipc
