// An array between stages as it is declared: its file, type, shape, unit and meaning, each said once.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/format/npy.h"

namespace tacipc {

enum class NpyType { f8, i4, u1 };

/// Length of an axis: a number, or a symbol that stands for the same number wherever it is used in a folder.
using Extent = std::variant<int, std::string_view>;
/// What the symbols stand for, as far as it is known.
using Extents = std::map<std::string_view, std::size_t>;

struct NpyField {
  std::string file;
  NpyType type = NpyType::f8;
  std::vector<Extent> shape = {};
  std::string unit = {};  // "code" of numbers that stand for words, which `meaning` lists
  std::string meaning = {};
  bool finite = true;  // every value
};

/// "(frames, #V, 3)"; symbols that are known as their numbers.
std::string shape_text(const NpyField& field, const Extents& known = {});

/// Compares a shape with the declared one and adds what the symbols in it stand for to `known`. \throw DataError naming
/// both shapes
void match_shape(const NpyField& field, const std::vector<std::size_t>& shape, const std::string& name, Extents& known);

/// \throw DataError naming the first value that is not finite, by its index
void check_finite(const NpyField& field, const NpyArray& array, const std::string& name);

/// The whole array, checked by the two above.
NpyArray read_field(const NpyField& field, const std::filesystem::path& path, Extents& known);

/// Writes the values, row-major, in the declared type and shape. \throw DataError if they are not as many as the shape
/// says. \pre every symbol is known
void write_field(const NpyField& field, const std::filesystem::path& path, const Extents& known,
                 const std::vector<double>& values);

}  // namespace tacipc
