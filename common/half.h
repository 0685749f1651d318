// Half precision (IEEE 754 binary16) for large unit vectors and radiance.
#pragma once

#include <bit>
#include <cstdint>

namespace tacipc {

/// The bits of the half nearest to a float, ties to even; beyond 65504 + half a step infinity, NaN stays NaN.
inline std::uint16_t to_half(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t sign = bits >> 16 & 0x8000, magnitude = bits & 0x7fffffff;
  if (magnitude > 0x7f800000) return static_cast<std::uint16_t>(sign | 0x7e00);
  if (magnitude >= 0x477ff000) return static_cast<std::uint16_t>(sign | 0x7c00);
  std::uint32_t half = 0;
  if (magnitude < 0x38800000) {
    // Subnormal: adding a half in float arithmetic aligns the mantissa and rounds as the processor does.
    half = std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + 0.5f) - 0x3f000000;
  } else {
    half = (magnitude - 0x38000000 + 0xfff + (magnitude >> 13 & 1)) >> 13;
  }
  return static_cast<std::uint16_t>(sign | half);
}

/// The value of a half, exactly.
inline float from_half(std::uint16_t half) {
  const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000) << 16, magnitude = half & 0x7fffu;
  if (magnitude >= 0x7c00) return std::bit_cast<float>(sign | 0x7f800000 | (magnitude & 0x3ff) << 13);
  // As a float of far too small exponent, then scaled by 2^112: right for subnormals too.
  return std::bit_cast<float>(sign | magnitude << 13) * 0x1p112f;
}

}  // namespace tacipc
