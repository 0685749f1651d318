// NumPy .npy files (version 1.0, C order, little-endian doubles), the arrays between stages.
#pragma once

#include <filesystem>
#include <vector>

namespace tacipc {

struct NpyArray {
  std::vector<std::size_t> shape;
  std::vector<double> data;  // row-major
};

/// \throw DataError if sizes disagree or it cannot be written.
void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape, const double* data);
/// Reads f8, f4, i8, i4 or u1 arrays in C or Fortran order. \throw DataError for anything else, with what was found.
NpyArray read_npy(const std::filesystem::path& path);

}  // namespace tacipc
