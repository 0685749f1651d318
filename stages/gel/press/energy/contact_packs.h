// Derivatives of contact and friction for eight pairs at a time.
#pragma once

#include <array>

#include "common/base/simd.h"
#include "common/base/types.h"

namespace tacipc {

/// Vertices of a pair whose derivatives are wanted, when they are of one primitive: `count` of the four from `first`
/// on.
struct WantedVertices {
  int first, count;
};
constexpr WantedVertices kPoint{0, 1}, kTriangle{1, 3}, kFirstEdge{0, 2};

/// Gradient and the lower blocks (a, b) with a ≥ b in the order 00 10 20 11 21 22 of up to three vertices, each column
/// by column; lanes of pairs that vanish are zero.
struct PackedBlocks {
  static constexpr int kBlocks = 6;
  Pack gradient[3][3];
  Pack blocks[kBlocks][9];
};

/// Where block (a, b) stands.
constexpr int block_index(int a, int b) { return b == 0 ? a : b == 1 ? 2 + a : 5; }

/// Eight stencils of a contact term; missing ones repeat the first.
using StencilPack = std::array<int, kLanes>;

}  // namespace tacipc
