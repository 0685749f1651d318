// Finds self-intersections of a surface, decided exactly.
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Two intersecting faces.
struct FacePair {
  int first;
  int second;  // > first
  friend bool operator==(const FacePair&, const FacePair&) = default;
};

/// All pairs of faces that share more than common vertices and edges, in ascending order. Vertices at the same position
/// count as common, regardless of their indices: parts that only touch there do not cross.
std::vector<FacePair> self_intersections(const TriangleMesh& mesh);

}  // namespace tacipc
