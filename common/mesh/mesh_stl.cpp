#include <array>
#include <cstdint>
#include <unordered_map>

#include "common/base/byte_reader.h"
#include "common/base/text_reader.h"
#include "common/mesh/mesh_formats.h"

namespace tacipc {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kFacetBytes = 50;  // normal, three corners, two attribute bytes

struct HashPoint {
  std::size_t operator()(const std::array<double, 3>& point) const {
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (const double value : point) {
      hash ^= std::bit_cast<std::uint64_t>(value);
      hash *= 0xff51afd7ed558ccdu;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

/// Assigns one index to corners of equal coordinates, in order of first occurrence.
class CornerIndex {
 public:
  explicit CornerIndex(std::vector<Vector3>& vertices) : vertices_(vertices) {}

  int of(const Vector3& point) {
    // NaNs never compare equal, so each remains a vertex of its own and is reported later. −0 becomes 0.
    const auto [found, fresh] =
        index_.try_emplace({point.x() + 0.0, point.y() + 0.0, point.z() + 0.0}, static_cast<int>(vertices_.size()));
    if (fresh) vertices_.push_back(point + Vector3::Zero());
    return found->second;
  }

 private:
  std::vector<Vector3>& vertices_;
  std::unordered_map<std::array<double, 3>, int, HashPoint> index_;
};

PolygonSoup read_binary(std::string_view bytes, const std::string& name) {
  ByteReader in(bytes, name);
  in.skip(kHeaderBytes, "the header of a binary STL");
  const auto count = in.read<std::uint32_t>("the facet count of a binary STL");
  const std::uint64_t needed = kHeaderBytes + 4 + std::uint64_t{kFacetBytes} * count;
  if (needed != bytes.size())
    throw DataError("{}: a binary STL of {} facets takes {} bytes, the file has {}", name, count, needed, bytes.size());
  PolygonSoup soup;
  CornerIndex index(soup.vertices);
  for (std::uint32_t f = 0; f < count; ++f) {
    in.skip(3 * sizeof(float), "a normal");
    std::array<int, 3> corners;
    const auto coordinate = [&] { return in.read<float>("a corner"); };
    for (int& corner : corners) corner = index.of({coordinate(), coordinate(), coordinate()});
    soup.add_polygon(corners);
    in.skip(2, "a facet");
  }
  return soup;
}

PolygonSoup read_ascii(std::string_view bytes, const std::string& name) {
  TextReader in(bytes, name);
  PolygonSoup soup;
  CornerIndex index(soup.vertices);
  const auto expect = [&](std::string_view wanted) {
    const std::string found = lower_case(in.word_anywhere());
    if (found != wanted)
      in.fail(fmt::format("expected '{}', found {}", wanted,
                          found.empty() ? "the end" : fmt::format("'{}'", shown(found))));
  };
  bool open = false;
  while (in.next_line()) {
    const std::string keyword = lower_case(in.word());
    if (keyword == "solid" && !open) {
      open = true;  // the rest of the line is a name
    } else if (keyword == "endsolid" && open) {
      open = false;
    } else if (keyword == "facet" && open) {
      const int line = in.line();
      expect("normal");
      for (int i = 0; i < 3; ++i) in.number_anywhere("the normal");
      expect("outer");
      expect("loop");
      std::array<int, 3> corners;
      for (int& corner : corners) {
        expect("vertex");
        corner = index.of({in.number_anywhere("x"), in.number_anywhere("y"), in.number_anywhere("z")});
      }
      expect("endloop");
      expect("endfacet");
      soup.add_polygon(corners, line);
    } else {
      in.fail(fmt::format("expected '{}', found '{}'", open ? "facet' or 'endsolid" : "solid", shown(keyword)));
    }
  }
  if (open) in.fail("the file ends inside a solid");
  return soup;
}

/// Returns whether the size fits a binary file's number of facets; such a file may begin with any word, even "solid".
bool has_size_of_binary(std::string_view bytes) {
  if (bytes.size() < kHeaderBytes + 4) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeaderBytes, sizeof(count));
  return kHeaderBytes + 4 + std::uint64_t{kFacetBytes} * count == bytes.size();
}

/// Returns whether the next bytes cannot be text, or the next word cannot begin a text file.
bool looks_binary(std::string_view bytes) {
  const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
  if (lower_case(bytes.substr(first, 5)) != "solid") return true;
  for (const char c : bytes.substr(0, 1024))
    if (c >= '\0' && c < ' ' && c != '\t' && c != '\n' && c != '\r' && c != '\f' && c != '\v') return true;
  return false;
}

}  // namespace

PolygonSoup read_stl(std::string_view bytes, const std::string& name) {
  if (has_size_of_binary(bytes)) return read_binary(bytes, name);
  const std::string_view text = plain_text(bytes, name);
  return looks_binary(text) ? read_binary(bytes, name) : read_ascii(text, name);
}

}  // namespace tacipc
