// Words and numbers of a text file, line by line, with the place of each fault.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tacipc {

/// Walks over a text that must outlive it. Lines end with LF, CR LF or CR; words are separated by blanks and tabs.
class TextReader {
 public:
  /// `first_line` is the number of the line that `text` begins with.
  TextReader(std::string_view text, std::string name, int first_line = 1);

  /// Moves to the next line that holds a word, cutting comments from `comment` on; false at the end.
  bool next_line(char comment = '\0');
  /// Next word of the current line; empty at its end.
  std::string_view word();
  /// Next word of the file, crossing line ends; empty at its end.
  std::string_view word_anywhere();
  /// The rest of the current line.
  std::string_view rest() const { return line_; }
  /// Appends the following line to the current one while it ends with a backslash.
  void join_continued();

  /// Next number of the current line; `what` names it in the message. Reads nan and inf as such.
  double number(std::string_view what);
  std::int64_t integer(std::string_view what);
  /// The same across line ends.
  double number_anywhere(std::string_view what);
  std::int64_t integer_anywhere(std::string_view what);

  /// \throw DataError `NAME:LINE: reason`
  [[noreturn]] void fail(const std::string& reason) const;

  /// Bytes after the current line: an upper bound on what can still come.
  std::size_t bytes_left() const { return line_.size() + text_.size() - next_; }
  int line() const { return line_number_; }
  const std::string& name() const { return name_; }

  double to_number(std::string_view word, std::string_view what) const;
  std::int64_t to_integer(std::string_view word, std::string_view what) const;

 private:
  bool take_line();

  std::string_view text_;
  std::string name_;
  std::string joined_;
  std::string_view line_;
  std::size_t next_ = 0;  // where the line after the current one begins
  int line_number_;
  int next_number_;
};

/// The text behind a UTF-8 byte-order mark, if it has one. \throw DataError `NAME: is UTF-16 text …` for UTF-16 and
/// UTF-32 of either byte order, with or without a mark.
std::string_view plain_text(std::string_view bytes, const std::string& name);

/// Lower-case copy (ASCII letters only).
std::string lower_case(std::string_view text);

/// A word as it may stand in a message: cut to a readable length, bytes that are not printable ASCII shown as '?'.
std::string shown(std::string_view word);

}  // namespace tacipc
