// The header of an EXR file, before the library reads it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tacipc {

inline constexpr std::uint64_t kLargestExrSide = 32768;    // pixels
inline constexpr std::uint64_t kLargestExrTile = 1 << 24;  // pixels; usual are 64 x 64
/// No EXR compression shrinks real pixels further; a file that claims so is corrupt.
inline constexpr std::uint64_t kLargestExrRatio = 10'000;

/// The library reads attributes as long as their types are, whatever size the file gives, and allocates what a size, a
/// preview or the number of tiles asks for before it looks whether the file is that long. \throw DataError if a size is
/// not that of its type, or the file is too small for what its header announces
void check_exr_header(std::string_view bytes, const std::string& name);

}  // namespace tacipc
