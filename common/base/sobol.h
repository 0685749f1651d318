// Sobol's sequence: points that fill a box more evenly than random ones.
#pragma once

#include <cstdint>

namespace tacipc {

/// Number of dimensions with direction numbers.
constexpr int kSobolDimensions = 16;

/// Returns coordinate `dimension` (from 0) of point `index` (from 0) of Sobol's sequence, in [0, 1), 32 bits: x = ⊕ v_k
/// over the set bits k of the index. Of every 2^m points, starting at a multiple of 2^m, one lies in each of the 2^m
/// equal intervals of a dimension. [Sobol 1967; direction numbers of Joe and Kuo 2008]
/// \pre 0 <= dimension < kSobolDimensions
double sobol(std::uint32_t index, int dimension);

}  // namespace tacipc
