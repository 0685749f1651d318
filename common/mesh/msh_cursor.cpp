#include "common/mesh/msh_cursor.h"

#include <algorithm>
#include <limits>

namespace tacipc {
namespace {

std::size_t offset_of(std::string_view file, std::string_view section) {
  return static_cast<std::size_t>(section.data() - file.data());
}

std::string_view up_to_end(std::string_view file, std::string_view section) {
  return file.substr(0, offset_of(file, section) + section.size());
}

int first_line_of_section(std::string_view file, std::string_view section, bool text) {
  if (!text) return 1;
  const std::string_view before = file.substr(0, offset_of(file, section));
  return 1 + static_cast<int>(std::ranges::count(before, '\n'));
}

}  // namespace

MshCursor::MshCursor(std::string_view file, std::string_view section, const std::string& name, Form form)
    : section_(section),
      text_form_(form == Form::text),
      text_(section, name, first_line_of_section(file, section, text_form_)),
      bytes_(up_to_end(file, section), name, form == Form::binary_big ? std::endian::big : std::endian::little) {
  bytes_.seek(offset_of(file, section));
}

int MshCursor::integer(std::string_view what) {
  if (!text_form_) return bytes_.read<std::int32_t>(what);
  const std::int64_t value = text_.integer_anywhere(what);
  if (value < std::numeric_limits<int>::min() || value > std::numeric_limits<int>::max())
    fail(fmt::format("{} {} is out of range", what, value));
  return static_cast<int>(value);
}

std::uint64_t MshCursor::size(std::string_view what) {
  if (!text_form_) return bytes_.read<std::uint64_t>(what);
  const std::int64_t value = text_.integer_anywhere(what);
  if (value < 0) fail(fmt::format("{} {} is negative", what, value));
  return static_cast<std::uint64_t>(value);
}

double MshCursor::real(std::string_view what) {
  return text_form_ ? text_.number_anywhere(what) : bytes_.read<double>(what);
}

std::uint64_t MshCursor::text_count(std::string_view what) {
  if (text_form_) return size(what);
  const std::string_view here = section_.substr(section_.size() - bytes_.left());
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(here.data(), here.data() + here.size(), value);
  if (error != std::errc() || end == here.data() + here.size() || *end != '\n')
    fail(fmt::format("{} is not an integer on a line of its own", what));
  bytes_.skip(static_cast<std::size_t>(end - here.data()) + 1, what);
  return value;
}

void MshCursor::skip_integers(std::uint64_t n, std::string_view what) {
  check_fits(n, 1, sizeof(std::int32_t), what);
  for (; n > 0; --n) integer(what);
}

void MshCursor::skip_reals(std::uint64_t n, std::string_view what) {
  for (; n > 0; --n) real(what);
}

/// Counts one more in a text, whose last line may lack its line end.
std::size_t MshCursor::left() const { return text_form_ ? text_.bytes_left() + 1 : bytes_.left(); }

void MshCursor::check_fits(std::uint64_t count, std::size_t words, std::size_t bytes, std::string_view what) const {
  if (count > left() / (text_form_ ? 2 * words : bytes))
    fail(fmt::format("{} {} do not fit into the {} bytes that follow", count, what, left() - (text_form_ ? 1 : 0)));
}

void MshCursor::fail(const std::string& reason) const {
  if (text_form_) text_.fail(reason);
  bytes_.fail(reason);
}

}  // namespace tacipc
