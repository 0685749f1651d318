// A surface of triangles in combined vertex indices.
#pragma once

#include <array>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// Vertices, edges and triangles of one surface, in combined vertex indices.
struct Surface {
  std::vector<int> vertices;              // ascending
  std::vector<std::array<int, 2>> edges;  // each once, lower index first, ascending
  std::vector<std::array<int, 3>> triangles;
};

/// Collects the primitives of a surface whose vertex indices are shifted by `offset`.
Surface make_surface(const Triangles& triangles, int offset);

}  // namespace tacipc
