// Declaration of an array between stages: file, type, shape, unit and meaning, each stated once.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/format/npy.h"

namespace tacipc {

/// Number type of a file: 64-bit float, 32-bit integer, or byte.
enum class NpyType { f8, i4, u1 };

/// Length of an axis: a number, or a symbol that stands for the same number in a whole folder.
using Extent = std::variant<int, std::string_view>;
/// Numbers for symbols, as far as they are known.
using Extents = std::map<std::string_view, std::size_t>;

/// Declaration of an array.
struct NpyField {
  std::string file;
  NpyType type = NpyType::f8;
  std::vector<Extent> shape = {};
  std::string unit = {};  // "code" for numbers that stand for words, which `meaning` lists
  std::string meaning = {};
  bool finite = true;  // whether every value must be finite
};

/// Returns "(frames, #V, 3)", with numbers for known symbols.
std::string shape_text(const NpyField& field, const Extents& known = {});

/// Compares a shape with the declared one and adds its symbols' numbers to `known`.
/// \throw DataError naming both shapes
void match_shape(const NpyField& field, const std::vector<std::size_t>& shape, const std::string& name, Extents& known);

/// Checks that all values are finite.
/// \throw DataError naming the index of the first one that is not
void check_finite(const NpyField& field, const NpyArray& array, const std::string& name);

/// Reads the whole array and checks shape and values.
NpyArray read_field(const NpyField& field, const std::filesystem::path& path, Extents& known);

/// Writes values, row-major, in the declared type and shape.
/// \pre every symbol is known
/// \throw DataError if their number does not fit the shape
void write_field(const NpyField& field, const std::filesystem::path& path, const Extents& known,
                 const std::vector<double>& values);

}  // namespace tacipc
