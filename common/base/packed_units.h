// From SI to the units of packed datasets: mm, N, N mm.
#pragma once

namespace tacipc {

inline constexpr double kMmPerM = 1e3;
inline constexpr double kNmmPerNm = 1e3;
inline constexpr double kNPerMm2PerPa = 1e-6;

}  // namespace tacipc
