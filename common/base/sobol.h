// Points that fill a box more evenly than random ones.
#pragma once

#include <cstdint>

namespace tacipc {

/// Dimensions there are direction numbers for.
constexpr int kSobolDimensions = 16;

/// Coordinate `dimension` (from 0) of point `index` (from 0) of Sobol's sequence, in [0, 1), 32 bits: x = ⊕ over the
/// set bits k of the index of v_k. Every 2^m points from a multiple of 2^m on have one in each of the 2^m equal
/// intervals of a dimension. [Sobol 1967; direction numbers of Joe and Kuo 2008] \pre 0 <= dimension < kSobolDimensions
double sobol(std::uint32_t index, int dimension);

}  // namespace tacipc
