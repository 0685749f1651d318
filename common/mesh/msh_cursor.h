// The numbers of a Gmsh file, whether it is text or binary.
#pragma once

#include <string>
#include <string_view>

#include "common/base/byte_reader.h"
#include "common/base/text_reader.h"

namespace tacipc {

/// Walks over one section of an MSH file: decimal words in text files, 4-byte integers, 8-byte sizes and doubles in
/// binary ones.
class MshCursor {
 public:
  enum class Form { text, binary_little, binary_big };

  /// `section` is part of `file` (the place in messages counts from the beginning of the file).
  MshCursor(std::string_view file, std::string_view section, const std::string& name, Form form);

  int integer(std::string_view what);
  std::uint64_t size(std::string_view what);
  double real(std::string_view what);
  /// A count written as text even in binary files (MSH 2.2).
  std::uint64_t text_count(std::string_view what);
  /// Skips `n` integers or doubles.
  void skip_integers(std::uint64_t n, std::string_view what);
  void skip_reals(std::uint64_t n, std::string_view what);

  /// \throw DataError if `count` things of at least `words` numbers and `bytes` bytes each cannot follow here.
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
