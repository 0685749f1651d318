// Reads the numbers of a Gmsh file, text or binary.
#pragma once

#include <string>
#include <string_view>

#include "common/base/byte_reader.h"
#include "common/base/text_reader.h"

namespace tacipc {

/// Reads one section of an MSH file from front to back: decimal words in text files, 4-byte integers, 8-byte sizes and
/// doubles in binary ones. `what` names a value in messages.
class MshCursor {
 public:
  enum class Form { text, binary_little, binary_big };

  /// \param section part of `file`; locations in messages count from the beginning of the file
  MshCursor(std::string_view file, std::string_view section, const std::string& name, Form form);

  int integer(std::string_view what);
  std::uint64_t size(std::string_view what);
  double real(std::string_view what);
  /// Reads a count that is text even in binary files (MSH 2.2).
  std::uint64_t text_count(std::string_view what);
  /// Skips `n` integers or doubles.
  void skip_integers(std::uint64_t n, std::string_view what);
  void skip_reals(std::uint64_t n, std::string_view what);

  /// Checks that `count` items can follow here.
  /// \param words numbers per item in a text file, at least
  /// \param bytes bytes per item in a binary file, at least
  /// \throw DataError if the section is too short
  void check_fits(std::uint64_t count, std::size_t words, std::size_t bytes, std::string_view what) const;
  [[noreturn]] void fail(const std::string& reason) const;
  bool is_text() const { return text_form_; }

 private:
  std::size_t left() const;

  std::string_view section_;
  bool text_form_;
  TextReader text_;
  ByteReader bytes_;
};

}  // namespace tacipc
