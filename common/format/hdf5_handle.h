// Handles of the HDF5 library that close themselves; used by the reader and writer only.
#pragma once

#include <string>
#include <utility>

#include "common/base/error.h"
#include "common/format/hdf5_writer.h"

namespace tacipc::hdf5 {

/// Equals the library's hid_t, whose header only .cpp files include.
using Id = std::int64_t;

/// Prepares the library; must be called before any other call of it. Messages are replaced by this project's, links
/// into other files are disabled, and the library's exit handler is turned off: a file that could not be closed (a full
/// disk) stays open in the library, which would crash when it closes the file again at the end of the program.
void begin();

/// Returns a new handle of IEEE 754 binary16, for which the library has no name.
Id half_type();

/// Owns an identifier; Close is the library's function for its kind.
template <auto Close>
class Handle {
 public:
  Handle(Id id, const std::string& file, const std::string& object, const char* what) : id_(id) {
    if (id_ < 0) throw DataError("{}: {}: {}", file, object, what);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) Close(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator Id() const { return id_; }
  /// Closes now; returns whether that succeeded.
  bool close() { return Close(std::exchange(id_, -1)) >= 0; }

 private:
  Id id_;
};

}  // namespace tacipc::hdf5
