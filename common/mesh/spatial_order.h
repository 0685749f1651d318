// An order in which neighbours in space stay near each other in memory.
#pragma once

#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// Indices of the points along a Z-order curve over their bounding box, 2²¹ cells along its longest side; points of one
/// cell by index.   [Morton 1966]
std::vector<int> spatial_order(const Positions& points);

/// The place of each point in that order.
std::vector<int> spatial_rank(const Positions& points);

}  // namespace tacipc
