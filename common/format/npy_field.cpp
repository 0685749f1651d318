#include "common/format/npy_field.h"

#include <fmt/ranges.h>

#include <cmath>
#include <optional>

#include "common/base/error.h"

namespace tacipc {
namespace {

using Shape = std::vector<std::size_t>;

/// Returns the length; nothing for an unknown symbol.
std::optional<std::size_t> length_of(const Extent& extent, const Extents& known) {
  if (const int* number = std::get_if<int>(&extent)) return static_cast<std::size_t>(*number);
  const auto found = known.find(std::get<std::string_view>(extent));
  return found == known.end() ? std::nullopt : std::optional(found->second);
}

std::string in_brackets(const std::vector<std::string>& lengths) {
  return fmt::format("({}{})", fmt::join(lengths, ", "), lengths.size() == 1 ? "," : "");
}

/// Returns the index of a value as text: "1, 17, 2".
std::string index_text(std::size_t at, const Shape& shape) {
  Shape index(shape.size());
  for (std::size_t d = shape.size(); d-- > 0; at /= shape[d]) index[d] = at % shape[d];
  return fmt::format("{}", fmt::join(index, ", "));
}

}  // namespace

std::string shape_text(const NpyField& field, const Extents& known) {
  std::vector<std::string> lengths;
  for (const Extent& extent : field.shape) {
    const auto length = length_of(extent, known);
    lengths.push_back(length ? std::to_string(*length) : std::string(std::get<std::string_view>(extent)));
  }
  return in_brackets(lengths);
}

void match_shape(const NpyField& field, const Shape& shape, const std::string& name, Extents& known) {
  bool fits = shape.size() == field.shape.size();
  Extents found = known;
  for (std::size_t d = 0; fits && d < shape.size(); ++d) {
    const auto length = length_of(field.shape[d], found);
    if (!length) found.emplace(std::get<std::string_view>(field.shape[d]), shape[d]);
    fits = length.value_or(shape[d]) == shape[d];
  }
  if (!fits) {
    std::vector<std::string> lengths;
    for (const std::size_t length : shape) lengths.push_back(std::to_string(length));
    throw DataError("{}: has the shape {}, expected {}", name, in_brackets(lengths), shape_text(field, known));
  }
  known = std::move(found);
}

void check_finite(const NpyField& field, const NpyArray& array, const std::string& name) {
  if (!field.finite) return;
  for (std::size_t i = 0; i < array.data.size(); ++i)
    if (!std::isfinite(array.data[i]))
      throw DataError("{}: the value at [{}] is not finite", name, index_text(i, array.shape));
}

NpyArray read_field(const NpyField& field, const std::filesystem::path& path, Extents& known) {
  NpyArray array = read_npy(path);
  match_shape(field, array.shape, path.string(), known);
  check_finite(field, array, path.string());
  return array;
}

void write_field(const NpyField& field, const std::filesystem::path& path, const Extents& known,
                 const std::vector<double>& values) {
  Shape shape;
  std::size_t count = 1;
  for (const Extent& extent : field.shape) {
    shape.push_back(length_of(extent, known).value());
    count *= shape.back();
  }
  if (values.size() != count)
    throw DataError("{}: {} values for the shape {}", path.string(), values.size(), shape_text(field, known));
  switch (field.type) {
    case NpyType::f8: return write_npy(path, shape, values.data());
    case NpyType::i4: return write_npy(path, shape, std::vector<std::int32_t>(values.begin(), values.end()).data());
    case NpyType::u1: return write_npy(path, shape, std::vector<std::uint8_t>(values.begin(), values.end()).data());
  }
}

}  // namespace tacipc
