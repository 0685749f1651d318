// Kinds of surface that a camera pixel can show.
#pragma once

#include <array>
#include <cstdint>

namespace tacipc {

/// Kind of surface at a pixel. Grey levels of segment.png are multiples of these numbers (render_folder.h).
enum class Segment : std::uint8_t { beside = 0, gel = 1, contact = 2, marker = 3, marker_in_contact = 4 };

/// Names of the segments, in the order of the enum.
inline constexpr std::array kSegmentNames{"beside the gel", "gel", "contact", "marker", "marker in contact"};

}  // namespace tacipc
