// Reads HDF5 files: names, attributes, and datasets one entry of the first axis at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/base/value.h"
#include "common/format/hdf5_writer.h"

namespace tacipc {

/// Reads a file that may come from an untrusted source. Every error of the library, and everything that Hdf5Writer does
/// not write, is a DataError that names file and object: links other than hard ones, numbers in other files, other
/// types, filters and chunks, a dataset larger than its file can hold or an entry larger than 256 MiB, and names in
/// groups that files cannot have. The library crashes on some damaged files (base/fragile_library.h).
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  /// Returns the file's name for messages.
  const std::string& name() const;

  /// Returns the names in a group, sorted; each one can name a file.
  std::vector<std::string> names(const std::string& group) const;
  bool has(const std::string& path) const;

  /// Returns the attributes by name, sorted; lists of lists as they were written.
  Value::Map attributes(const std::string& object) const;
  /// Returns an attribute as text.
  /// \throw DataError if it does not exist or is not a text
  std::string text_attribute(const std::string& object, const std::string& attribute) const;
  /// Returns a text attribute that names a file or folder.
  /// \throw DataError if it cannot name one
  std::string name_attribute(const std::string& object, const std::string& attribute) const;
  /// Returns an attribute as a whole number ≥ 0.
  /// \throw DataError if it does not exist or is not one
  std::size_t count_attribute(const std::string& object, const std::string& attribute) const;

  /// Return number type and extents of a dataset.
  NumberType type(const std::string& dataset) const;
  std::vector<std::size_t> shape(const std::string& dataset) const;
  /// Returns the bytes of one entry of the first axis.
  std::string read_frame(const std::string& dataset, std::size_t frame) const;
  /// Returns the bytes of a whole dataset.
  std::string read(const std::string& dataset) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace tacipc
