// What a pixel of the camera shows.
#pragma once

#include <array>
#include <cstdint>

namespace tacipc {

enum class Segment : std::uint8_t { beside = 0, gel = 1, contact = 2, marker = 3, marker_in_contact = 4 };

inline constexpr std::array kSegmentNames{"beside the gel", "gel", "contact", "marker", "marker in contact"};

}  // namespace tacipc
