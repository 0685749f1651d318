// Numbers rounded to a power of two: they keep their type and unit, and what compresses badly is gone.
#pragma once

#include <cmath>
#include <vector>

namespace tacipc {

/// Moves each value to the nearest multiple of 2^exponent, of two to the even one: by half a step at most. NaN and
/// infinity stay. Beyond 2^24 steps floats are coarser than a step, and stay too.
template <typename T>
void round_to(std::vector<T>& values, int exponent) {
  const T step = std::ldexp(T{1}, exponent), steps = std::ldexp(T{1}, -exponent);
  for (T& value : values) value = std::nearbyint(value * steps) * step;
}

}  // namespace tacipc
