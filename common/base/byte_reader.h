// Reads numbers of a binary file in either byte order, never past its end.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include "common/base/error.h"

namespace tacipc {

/// Reads bytes, which must outlive the reader, from front to back.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::string name, std::endian order = std::endian::little)
      : bytes_(bytes), name_(std::move(name)), swap_(order != std::endian::native) {}

  /// Reads the next value of arithmetic type T; `what` names it in messages.
  template <typename T>
  T read(std::string_view what) {
    need(sizeof(T), what);
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (swap_) std::ranges::reverse(raw);
    return std::bit_cast<T>(raw);
  }

  /// Skips bytes; `what` names them in messages.
  void skip(std::size_t count, std::string_view what) {
    need(count, what);
    at_ += count;
  }
  /// Moves to a position, at most the end.
  void seek(std::size_t at) { at_ = std::min(at, bytes_.size()); }

  /// Returns the current position.
  std::size_t at() const { return at_; }
  /// Returns the number of remaining bytes.
  std::size_t left() const { return bytes_.size() - at_; }
  const std::string& name() const { return name_; }

  /// Fails at the current position.
  /// \throw DataError `NAME: reason at byte N`
  [[noreturn]] void fail(const std::string& reason) const {
    throw DataError(fmt::format("{}: {} at byte {}", name_, reason, at_));
  }

 private:
  void need(std::size_t count, std::string_view what) const {
    if (count > left()) fail(fmt::format("the file ends inside {}", what));
  }

  std::string_view bytes_;
  std::string name_;
  bool swap_;
  std::size_t at_ = 0;
};

}  // namespace tacipc
