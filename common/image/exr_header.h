// Checks the header of an EXR file before the library reads it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tacipc {

inline constexpr std::uint64_t kLargestExrSide = 32768;    // pixels
inline constexpr std::uint64_t kLargestExrTile = 1 << 24;  // pixels; usual tiles are 64 x 64
/// Largest compression ratio. No EXR compression shrinks real pixels further, so a file beyond it is corrupt.
inline constexpr std::uint64_t kLargestExrRatio = 10'000;

/// Checks the header's sizes against the file. The library reads attributes at the length of their types, whatever size
/// the file gives, and allocates memory for sizes, previews and tiles before it checks the file's length.
/// \throw DataError if a size does not fit its type, or the file is too small for its header
void check_exr_header(std::string_view bytes, const std::string& name);

}  // namespace tacipc
