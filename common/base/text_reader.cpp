#include "common/base/text_reader.h"

#include <algorithm>
#include <cstdlib>

#include "common/base/error.h"
#include "common/base/parse.h"

namespace tacipc {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";
constexpr std::size_t kLongestShown = 40;

std::string_view skip_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text;
}

}  // namespace

TextReader::TextReader(std::string_view text, std::string name, int first_line)
    : text_(text), name_(std::move(name)), line_number_(first_line), next_number_(first_line) {}

bool TextReader::take_line() {
  if (next_ >= text_.size()) {
    line_ = {};
    return false;
  }
  const std::size_t end = std::min(text_.find_first_of("\r\n", next_), text_.size());
  line_ = text_.substr(next_, end - next_);
  next_ = std::min(end + 1, text_.size());
  if (end + 1 < text_.size() && text_[end] == '\r' && text_[end + 1] == '\n') ++next_;
  line_number_ = next_number_++;
  return true;
}

bool TextReader::next_line(char comment) {
  while (take_line()) {
    if (comment != '\0') line_ = line_.substr(0, line_.find(comment));
    line_ = skip_blanks(line_);
    if (!line_.empty()) return true;
  }
  return false;
}

void TextReader::join_continued() {
  const auto trimmed = [](std::string_view line) {
    return line.substr(0, std::min(line.find_last_not_of(kBlanks) + 1, line.size()));
  };
  if (trimmed(line_).empty() || trimmed(line_).back() != '\\') return;
  const int first = line_number_;
  std::string all(trimmed(line_));
  while (!all.empty() && all.back() == '\\') {
    all.pop_back();
    if (!take_line()) break;
    all += ' ';
    all += trimmed(line_);
  }
  joined_ = std::move(all);
  line_ = joined_;
  line_number_ = first;
}

std::string_view TextReader::word() {
  line_ = skip_blanks(line_);
  const std::string_view found = line_.substr(0, line_.find_first_of(kBlanks));
  line_.remove_prefix(found.size());
  return found;
}

std::string_view TextReader::word_anywhere() {
  for (;;) {
    const std::string_view found = word();
    if (!found.empty() || !take_line()) return found;
  }
}

double TextReader::to_number(std::string_view word, std::string_view what) const {
  std::string_view digits = word;
  if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || end != digits.data() + digits.size() || error == std::errc::invalid_argument)
    fail(word.empty() ? fmt::format("{} is missing", what) : fmt::format("{} '{}' is not a number", what, shown(word)));
  // Too large becomes infinite, which the caller refuses; too small becomes zero.
  if (error == std::errc::result_out_of_range) return std::strtod(std::string(digits).c_str(), nullptr);
  return value;
}

std::int64_t TextReader::to_integer(std::string_view word, std::string_view what) const {
  std::string_view digits = word;
  if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') digits.remove_prefix(1);
  const auto value = parse_number<std::int64_t>(digits);
  if (!value)
    fail(word.empty() ? fmt::format("{} is missing", what)
                      : fmt::format("{} '{}' is not an integer", what, shown(word)));
  return *value;
}

double TextReader::number(std::string_view what) { return to_number(word(), what); }
std::int64_t TextReader::integer(std::string_view what) { return to_integer(word(), what); }
double TextReader::number_anywhere(std::string_view what) { return to_number(word_anywhere(), what); }
std::int64_t TextReader::integer_anywhere(std::string_view what) { return to_integer(word_anywhere(), what); }

void TextReader::fail(const std::string& reason) const {
  throw DataError(fmt::format("{}:{}: {}", name_, line_number_, reason));
}

std::string_view plain_text(std::string_view bytes, const std::string& name) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\xEF\xBB\xBF"sv)) return bytes.substr(3);
  const auto refuse = [&](const char* encoding) {
    throw DataError("{}: is {} text; save it as UTF-8", name, encoding);
  };
  if (bytes.starts_with("\xFF\xFE\0\0"sv) || bytes.starts_with("\0\0\xFE\xFF"sv)) refuse("UTF-32");
  // Without a mark: ASCII letters with a zero before or after each, which occurs in no other text.
  const auto zeros_at = [&](std::size_t first) {
    return bytes.size() >= 4 && bytes[first] == '\0' && bytes[first + 2] == '\0' && bytes[1 - first] != '\0' &&
           bytes[3 - first] != '\0';
  };
  if (bytes.starts_with("\xFF\xFE"sv) || zeros_at(1)) refuse("UTF-16 (little-endian)");
  if (bytes.starts_with("\xFE\xFF"sv) || zeros_at(0)) refuse("UTF-16 (big-endian)");
  return bytes;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::string shown(std::string_view word) {
  std::string text(word.substr(0, kLongestShown));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return word.size() > kLongestShown ? text + "…" : text;
}

}  // namespace tacipc
