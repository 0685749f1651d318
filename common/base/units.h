// Units of configurations, pages and packed data, in SI.
#pragma once

#include <numbers>

namespace tacipc {

inline constexpr double kMillimetre = 1e-3;
inline constexpr double kMicrometre = 1e-6;
inline constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace tacipc
