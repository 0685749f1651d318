// Reading HDF5 files: names, attributes, and datasets one entry of the first axis at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/base/value.h"
#include "common/format/hdf5_writer.h"

namespace tacipc {

/// The file may be a stranger's, and nothing that it says is trusted. Any fault of the library, or something that
/// Hdf5Writer does not write, is a DataError that names file and object: links other than hard ones, numbers in other
/// files, other types, filters and chunks, a dataset larger than its file can hold or an entry larger than 256 MiB, and
/// names in groups that files cannot have. The library crashes on some damaged files (base/fragile_library.h).
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  /// Of the file, for messages.
  const std::string& name() const;

  /// Names in a group, sorted, each one that a file can have.
  std::vector<std::string> names(const std::string& group) const;
  bool has(const std::string& path) const;

  /// Attributes by name, sorted; lists of lists as they were written.
  Value::Map attributes(const std::string& object) const;
  /// One of them as text. \throw DataError if there is none or it is not a text
  std::string text_attribute(const std::string& object, const std::string& attribute) const;
  /// The same for a text that names a file or folder. \throw DataError if it cannot
  std::string name_attribute(const std::string& object, const std::string& attribute) const;
  /// One of them as a whole number from 0 on. \throw DataError if there is none or it is not one
  std::size_t count_attribute(const std::string& object, const std::string& attribute) const;

  NumberType type(const std::string& dataset) const;
  std::vector<std::size_t> shape(const std::string& dataset) const;
  /// Bytes of one entry of the first axis.
  std::string read_frame(const std::string& dataset, std::size_t frame) const;
  std::string read(const std::string& dataset) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace tacipc
