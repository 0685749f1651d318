#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "common/base/byte_reader.h"
#include "common/base/text_reader.h"
#include "common/mesh/mesh_formats.h"

namespace tacipc {
namespace {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<Scalar> scalar_named(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, Scalar>, 16> kNames{{{"char", Scalar::int8},
                                                                        {"int8", Scalar::int8},
                                                                        {"uchar", Scalar::uint8},
                                                                        {"uint8", Scalar::uint8},
                                                                        {"short", Scalar::int16},
                                                                        {"int16", Scalar::int16},
                                                                        {"ushort", Scalar::uint16},
                                                                        {"uint16", Scalar::uint16},
                                                                        {"int", Scalar::int32},
                                                                        {"int32", Scalar::int32},
                                                                        {"uint", Scalar::uint32},
                                                                        {"uint32", Scalar::uint32},
                                                                        {"float", Scalar::float32},
                                                                        {"float32", Scalar::float32},
                                                                        {"double", Scalar::float64},
                                                                        {"float64", Scalar::float64}}};
  for (const auto& [name, scalar] : kNames)
    if (name == word) return scalar;
  return std::nullopt;
}

std::size_t size_of(Scalar scalar) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(scalar)];
}

struct Property {
  std::string name;
  Scalar type;
  std::optional<Scalar> count_type;  // type of a list's count
};

struct Element {
  std::string name;
  std::uint64_t count;
  std::vector<Property> properties;
};

struct PlyHeader {
  bool ascii = true;
  std::endian order = std::endian::little;
  std::vector<Element> elements;
  std::size_t body = 0;  // first byte after the header
  int body_line = 1;
};

Scalar scalar_type(const TextReader& in, std::string_view word) {
  const std::optional<Scalar> scalar = scalar_named(word);
  if (!scalar) in.fail(fmt::format("'{}' is not a PLY number type", shown(word)));
  return *scalar;
}

PlyHeader read_header(std::string_view bytes, const std::string& name) {
  constexpr std::string_view kEnd = "end_header";
  std::size_t end = bytes.find(kEnd);
  // A comment may contain the word; the header ends with a line of its own.
  while (end != std::string_view::npos && end > 0 && bytes[end - 1] != '\n' && bytes[end - 1] != '\r')
    end = bytes.find(kEnd, end + 1);
  if (end == std::string_view::npos) throw DataError("{}: the file ends inside the PLY header", name);
  PlyHeader header;
  header.body = end + kEnd.size();
  while (header.body < bytes.size() && (bytes[header.body] == ' ' || bytes[header.body] == '\t')) ++header.body;
  if (header.body < bytes.size() && bytes[header.body] == '\r') ++header.body;
  if (header.body < bytes.size() && bytes[header.body] == '\n') ++header.body;

  TextReader in(bytes.substr(0, end), name);
  bool has_format = false;
  if (!in.next_line() || in.word() != "ply") in.fail("expected 'ply'");
  while (in.next_line()) {
    const std::string_view keyword = in.word();
    if (keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "format") {
      const std::string_view format = in.word();
      has_format = true;
      header.ascii = format == "ascii";
      header.order = format == "binary_big_endian" ? std::endian::big : std::endian::little;
      if (!header.ascii && format != "binary_big_endian" && format != "binary_little_endian")
        in.fail(fmt::format("'{}' is not a PLY format", shown(format)));
    } else if (keyword == "element") {
      const std::string element(in.word());
      const std::int64_t count = in.integer("element count");
      if (count < 0) in.fail(fmt::format("element count {} is negative", count));
      header.elements.push_back({element, static_cast<std::uint64_t>(count), {}});
    } else if (keyword == "property") {
      if (header.elements.empty()) in.fail("property without an element");
      Property property;
      std::string_view type = in.word();
      if (type == "list") {
        property.count_type = scalar_type(in, in.word());
        if (*property.count_type >= Scalar::float32) in.fail("a list must be counted by integers");
        type = in.word();
      }
      property.type = scalar_type(in, type);
      property.name = in.word();
      header.elements.back().properties.push_back(std::move(property));
    } else {
      in.fail(fmt::format("'{}' is not a PLY header line", shown(keyword)));
    }
  }
  if (!has_format) in.fail("the PLY header has no format line");
  header.body_line = in.line() + 2;
  return header;
}

/// Reads the numbers of the body, text or binary.
class Body {
 public:
  Body(std::string_view bytes, const std::string& name, const PlyHeader& header)
      : ascii_(header.ascii),
        text_(bytes.substr(header.ascii ? header.body : bytes.size()), name, header.body_line),
        binary_(bytes, name, header.order) {
    binary_.seek(header.body);
  }

  double number(Scalar type, const std::string& what) {
    if (ascii_) return text_.number_anywhere(what);
    switch (type) {
      case Scalar::int8: return binary_.read<std::int8_t>(what);
      case Scalar::uint8: return binary_.read<std::uint8_t>(what);
      case Scalar::int16: return binary_.read<std::int16_t>(what);
      case Scalar::uint16: return binary_.read<std::uint16_t>(what);
      case Scalar::int32: return binary_.read<std::int32_t>(what);
      case Scalar::uint32: return binary_.read<std::uint32_t>(what);
      case Scalar::float32: return binary_.read<float>(what);
      case Scalar::float64: return binary_.read<double>(what);
    }
    return 0.0;
  }

  /// Reads a whole number in [0, most].
  std::uint64_t whole(Scalar type, const std::string& what, std::uint64_t most) {
    const double value = number(type, what);
    if (!(value >= 0.0) || value > static_cast<double>(most) || value != std::floor(value))
      fail(fmt::format("{} is {}, outside [0, {}]", what, value, most));
    return static_cast<std::uint64_t>(value);
  }

  /// Returns the smallest number of bytes of a value of this type.
  std::size_t smallest(Scalar type) const { return ascii_ ? 2 : size_of(type); }
  /// Returns the number of bytes left; one more in a text, whose last line may lack its line end.
  std::size_t left() const { return ascii_ ? text_.bytes_left() + 1 : binary_.left(); }
  int line() const { return ascii_ ? text_.line() : 0; }
  bool ascii() const { return ascii_; }

  [[noreturn]] void fail(const std::string& reason) const {
    if (ascii_) text_.fail(reason);
    binary_.fail(reason);
  }

 private:
  bool ascii_;
  TextReader text_;
  ByteReader binary_;
};

void check_fits(const Element& element, const Body& body) {
  std::uint64_t bytes = 0;
  for (const Property& property : element.properties)
    bytes += body.smallest(property.count_type.value_or(property.type));
  if (bytes > 0 && element.count > body.left() / bytes)
    body.fail(fmt::format("{} elements '{}' do not fit into the {} bytes that follow", element.count,
                          shown(element.name), body.left()));
}

void read_vertices(const Element& element, Body& body, PolygonSoup& soup) {
  std::array<bool, 3> has{};
  for (const Property& property : element.properties)
    for (std::size_t i = 0; i < 3; ++i)
      has[i] = has[i] || (!property.count_type && property.name == std::string(1, "xyz"[i]));
  if (!has[0] || !has[1] || !has[2]) body.fail("the vertices have no x, y and z");
  soup.vertices.reserve(element.count);
  for (std::uint64_t v = 0; v < element.count; ++v) {
    Vector3 point = Vector3::Zero();
    for (const Property& property : element.properties) {
      if (property.count_type) {
        for (auto n = body.whole(*property.count_type, "list length", body.left()); n > 0; --n)
          body.number(property.type, property.name);
        continue;
      }
      const double value = body.number(property.type, property.name);
      if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
        point[property.name[0] - 'x'] = value;
    }
    soup.vertices.push_back(point);
  }
}

/// Reads faces, or skips any element if `soup` is null.
void read_lists(const Element& element, Body& body, PolygonSoup* soup) {
  if (element.properties.empty()) return;
  std::vector<int> polygon;
  for (std::uint64_t f = 0; f < element.count; ++f) {
    for (const Property& property : element.properties) {
      if (!property.count_type) {
        body.number(property.type, property.name);
        continue;
      }
      const bool wanted = soup != nullptr && (property.name == "vertex_indices" || property.name == "vertex_index");
      const std::uint64_t length =
          body.whole(*property.count_type, "list length", body.left() / body.smallest(property.type));
      polygon.clear();
      for (std::uint64_t i = 0; i < length; ++i) {
        if (!wanted)
          body.number(property.type, property.name);
        else
          polygon.push_back(
              static_cast<int>(body.whole(property.type, "vertex index", std::numeric_limits<int>::max())));
      }
      if (wanted && body.ascii()) soup->add_polygon(polygon, body.line());
      if (wanted && !body.ascii()) soup->add_polygon(polygon);
    }
  }
}

}  // namespace

PolygonSoup read_ply(std::string_view bytes, const std::string& name) {
  bytes = plain_text(bytes, name);
  const PlyHeader header = read_header(bytes, name);
  Body body(bytes, name, header);
  PolygonSoup soup;
  for (const Element& element : header.elements) {
    check_fits(element, body);
    if (element.name == "vertex")
      read_vertices(element, body, soup);
    else
      read_lists(element, body, element.name == "face" ? &soup : nullptr);
  }
  return soup;
}

}  // namespace tacipc
