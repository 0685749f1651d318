// Writes HDF5 files whose bytes depend on their content alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/value.h"

namespace tacipc {

/// Number types of a file, little-endian.
enum class NumberType { u8, i32, f16, f32, f64 };

/// Returns the bytes of a number.
std::size_t size_of(NumberType type);
/// Returns NumPy's name: "uint8", "int32", "float16", "float32", "float64".
const char* name_of(NumberType type);
/// Returns the type as in NPY files: "|u1", "<i4", "<f2", "<f4", "<f8".
const char* npy_type_of(NumberType type);
/// Converts values to bytes of a type; halves and floats are rounded to nearest.
/// \pre whole numbers fit their type
std::string to_bytes(NumberType type, const std::vector<double>& values);
/// Converts bytes back to numbers.
std::vector<double> from_bytes(NumberType type, std::string_view bytes);

/// Writes a file in the format of HDF5 1.8, which every later library reads, without creation times. Paths are absolute
/// ("/data/a/obs").
/// \throw DataError from every function, naming file and object, if the library reports an error
class Hdf5Writer {
 public:
  explicit Hdf5Writer(const std::filesystem::path& path);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  /// Makes a group and its parents; does nothing if it exists.
  void group(const std::string& path);
  /// Adds an attribute to a group or dataset: a text, a number, a list of numbers or of equally long lists of numbers.
  /// Booleans become whole numbers.
  void attribute(const std::string& object, const std::string& name, const Value& value);

  /// Creates a dataset of this type and shape.
  /// \param chunk_by_frame true: each entry of the first axis is a chunk, with shuffled bytes, compressed by gzip;
  /// false: the dataset is contiguous
  void dataset(const std::string& path, NumberType type, const std::vector<std::size_t>& shape, bool chunk_by_frame);
  /// Fills one entry of the first axis.
  /// \pre the bytes are those of one entry
  void write_frame(const std::string& path, std::size_t frame, std::string_view bytes);
  /// Writes a whole contiguous dataset.
  void write(const std::string& path, NumberType type, const std::vector<std::size_t>& shape, std::string_view bytes);
  /// Writes a one-dimensional dataset of texts (fixed length, padded with zeros).
  void write_texts(const std::string& path, const std::vector<std::string>& texts);

  /// Writes the rest.
  /// \throw DataError if that fails (a full disk)
  void close();

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace tacipc
