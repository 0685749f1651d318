// NumPy .npy files (version 1.0, C order, little-endian), the arrays between stages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace tacipc {

struct NpyArray {
  std::vector<std::size_t> shape;
  std::vector<double> data;  // row-major
};

/// Writes f8, i4 or u1 values in row-major order. \throw DataError if the shape is too large or the file cannot be
/// written.
void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape, const double* data);
void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape, const std::int32_t* data);
void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape, const std::uint8_t* data);
/// Reads f8, f4, i8, i4 or u1 arrays in C or Fortran order. \throw DataError for anything else, with what was found.
NpyArray read_npy(const std::filesystem::path& path);
/// The same, which must have this shape. \throw DataError naming both shapes
NpyArray read_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape);

}  // namespace tacipc
