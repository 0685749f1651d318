// Derivatives of contact and friction for eight pairs at a time.
#pragma once

#include <array>

#include "common/base/simd.h"
#include "common/base/types.h"

namespace tacipc {

/// Vertices of a pair whose derivatives are wanted; they form one primitive: `count` of the four, starting at `first`.
struct WantedVertices {
  int first, count;
};
constexpr WantedVertices kPoint{0, 1}, kTriangle{1, 3}, kFirstEdge{0, 2};

/// Gradient and Hessian over up to three vertices: the lower blocks (a, b), a ≥ b, in the order 00 10 20 11 21 22, each
/// column by column. Lanes of pairs that vanish are zero.
struct PackedBlocks {
  static constexpr int kBlocks = 6;
  Pack gradient[3][3];
  Pack blocks[kBlocks][9];
};

/// Index of block (a, b) in PackedBlocks::blocks.
constexpr int block_index(int a, int b) { return b == 0 ? a : b == 1 ? 2 + a : 5; }

/// Eight stencils of a contact term; missing ones repeat the first.
using StencilPack = std::array<int, kLanes>;

}  // namespace tacipc
