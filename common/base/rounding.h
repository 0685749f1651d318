// Rounds numbers to a power of two, without changing type or unit, so that they compress well.
#pragma once

#include <cmath>
#include <vector>

namespace tacipc {

/// Rounds each value to the nearest multiple of 2^exponent, ties to even. NaN and infinity stay. Floats beyond 2^24
/// steps are coarser than a step, and stay unchanged.
template <typename T>
void round_to(std::vector<T>& values, int exponent) {
  const T step = std::ldexp(T{1}, exponent), steps = std::ldexp(T{1}, -exponent);
  for (T& value : values) value = std::nearbyint(value * steps) * step;
}

}  // namespace tacipc
