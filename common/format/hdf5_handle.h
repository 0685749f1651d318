// Handles of the HDF5 library, closed when they go; shared by its reader and writer alone.
#pragma once

#include <string>
#include <utility>

#include "common/base/error.h"
#include "common/format/hdf5_writer.h"

namespace tacipc::hdf5 {

/// The library's hid_t, whose header only .cpp files include.
using Id = std::int64_t;

/// To be called before anything else of the library. Messages are ours; links into other files lead nowhere; and
/// nothing is left to the library's own end: a file that could not be closed (a full disk) stays open in it, and when
/// it closes that once more at the end of the program it crashes.
void begin();

/// A new handle of IEEE 754 binary16, which the library has no name for.
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
  /// Closes now and tells whether that worked.
  bool close() { return Close(std::exchange(id_, -1)) >= 0; }

 private:
  Id id_;
};

}  // namespace tacipc::hdf5
