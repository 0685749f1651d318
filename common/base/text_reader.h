// Reads words and numbers of a text file, line by line, with the location of each error.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tacipc {

/// Reads a text, which must outlive the reader. Lines end with LF, CR LF or CR; words are separated by blanks and tabs.
class TextReader {
 public:
  /// \param first_line number of the line with which `text` begins
  TextReader(std::string_view text, std::string name, int first_line = 1);

  /// Moves to the next line with a word, cutting comments that begin with `comment`; returns false at the end.
  bool next_line(char comment = '\0');
  /// Returns the next word of the current line; empty at the line's end.
  std::string_view word();
  /// Returns the next word of the file, across line ends; empty at the file's end.
  std::string_view word_anywhere();
  /// Returns the rest of the current line.
  std::string_view rest() const { return line_; }
  /// Appends following lines to the current one while it ends with a backslash.
  void join_continued();

  /// Returns the next number of the current line; `what` names it in messages. Accepts nan and inf.
  double number(std::string_view what);
  std::int64_t integer(std::string_view what);
  /// Return the next number, across line ends.
  double number_anywhere(std::string_view what);
  std::int64_t integer_anywhere(std::string_view what);

  /// Fails in the current line.
  /// \throw DataError `NAME:LINE: reason`
  [[noreturn]] void fail(const std::string& reason) const;

  /// Returns the number of unread bytes: an upper bound on the remaining content.
  std::size_t bytes_left() const { return line_.size() + text_.size() - next_; }
  int line() const { return line_number_; }
  const std::string& name() const { return name_; }

  /// Converts a word; `what` names it in messages.
  double to_number(std::string_view word, std::string_view what) const;
  std::int64_t to_integer(std::string_view word, std::string_view what) const;

 private:
  bool take_line();

  std::string_view text_;
  std::string name_;
  std::string joined_;
  std::string_view line_;
  std::size_t next_ = 0;  // start of the line after the current one
  int line_number_;
  int next_number_;
};

/// Returns the text after a UTF-8 byte-order mark, if it has one.
/// \throw DataError `NAME: is UTF-16 text …` for UTF-16 and UTF-32 of either byte order, with or without a mark
std::string_view plain_text(std::string_view bytes, const std::string& name);

/// Returns a lower-case copy (ASCII letters only).
std::string lower_case(std::string_view text);

/// Returns a word for messages: cut to a readable length, bytes that are not printable ASCII shown as '?'.
std::string shown(std::string_view word);

}  // namespace tacipc
