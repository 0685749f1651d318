// What every surface of a body must be.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "common/base/types.h"

namespace tacipc {

/// Every directed edge once, its reverse once: closed, oriented, two triangles an edge.
inline void expect_closed(const Triangles& triangles) {
  std::map<std::pair<int, int>, int> edges;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) ++edges[{triangles(f, k), triangles(f, (k + 1) % 3)}];
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1) << edge.first << "-" << edge.second;
    ASSERT_TRUE(edges.contains({edge.second, edge.first})) << edge.first << "-" << edge.second;
  }
}

}  // namespace tacipc
