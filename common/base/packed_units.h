// Conversion from SI to the units of packed datasets: mm, N, N mm, degrees.
#pragma once

#include <numbers>

namespace tacipc {

inline constexpr double kMmPerM = 1e3;
inline constexpr double kNmmPerNm = 1e3;
inline constexpr double kNPerMm2PerPa = 1e-6;
inline constexpr double kDegPerRad = 180.0 / std::numbers::pi;

}  // namespace tacipc
