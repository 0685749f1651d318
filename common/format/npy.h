// NumPy .npy files (version 1.0, C order, little-endian), in which stages exchange arrays.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace tacipc {

/// An array in memory.
struct NpyArray {
  std::vector<std::size_t> shape;
  std::vector<double> data;  // row-major
};

/// Writes f8, i4 or u1 values in row-major order.
/// \throw DataError if the shape is too large or the file cannot be written
void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape, const double* data);
void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape, const std::int32_t* data);
void write_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape, const std::uint8_t* data);
/// Returns the file's bytes for values of any type, given as they lie in memory; `type` is NumPy's, such as "<f4".
std::string npy_bytes(const std::vector<std::size_t>& shape, std::string_view type, std::string_view values);
/// Reads f8, f4, i8, i4 or u1 arrays in C or Fortran order.
/// \throw DataError for any other content, which the message names
NpyArray read_npy(const std::filesystem::path& path);
/// Reads from the content of a file; `name` stands for it in messages.
NpyArray read_npy_bytes(std::string_view bytes, const std::string& name);
/// Reads an array that must have this shape.
/// \throw DataError naming both shapes
NpyArray read_npy(const std::filesystem::path& path, const std::vector<std::size_t>& shape);

/// Reads an array one entry of its first axis at a time, for files that need not fit into memory.
class NpyFrames {
 public:
  /// \throw DataError as read_npy(), and for Fortran order
  explicit NpyFrames(const std::filesystem::path& path);

  const std::vector<std::size_t>& shape() const { return shape_; }
  /// Returns the shape of one entry: without the first axis.
  std::vector<std::size_t> frame_shape() const { return {shape_.begin() + 1, shape_.end()}; }
  /// Reads one entry.
  /// \pre frame < shape()[0]
  /// \throw DataError if the file has been truncated meanwhile
  std::vector<double> frame(std::size_t frame);

 private:
  std::string name_;
  std::ifstream file_;
  std::vector<std::size_t> shape_;
  std::string kind_;
  bool big_endian_ = false;
  std::size_t data_at_ = 0;
  std::size_t frame_values_ = 1;
};

}  // namespace tacipc
