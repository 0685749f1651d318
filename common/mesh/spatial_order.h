// Orders points so that neighbours in space are close in memory.
#pragma once

#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// Returns indices of the points along a Z-order curve over their bounding box, 2²¹ cells along its longest side;
/// points of one cell are ordered by index.   [Morton 1966]
std::vector<int> spatial_order(const Positions& points);

/// Returns the rank of each point in that order.
std::vector<int> spatial_rank(const Positions& points);

}  // namespace tacipc
