#include <limits>

#include "common/base/error.h"
#include "common/base/text_reader.h"
#include "common/mesh/mesh_formats.h"

namespace tacipc {
namespace {

constexpr std::size_t kVertexBytes = 6;  // "0 0 0\n"
constexpr std::size_t kFaceBytes = 2;    // "1\n"

std::size_t count(TextReader& in, std::string_view what, std::size_t bytes_each) {
  const std::int64_t number = in.integer_anywhere(what);
  if (number < 0) in.fail(fmt::format("{} {} is negative", what, number));
  // The last line may lack its end.
  if (static_cast<std::uint64_t>(number) > in.bytes_left() / bytes_each + 1)
    in.fail(fmt::format("{} {} does not fit into the {} bytes that follow", what, number, in.bytes_left()));
  return static_cast<std::size_t>(number);
}

}  // namespace

PolygonSoup read_off(std::string_view bytes, const std::string& name) {
  TextReader in(plain_text(bytes, name), name);
  if (!in.next_line('#')) in.fail("expected 'OFF', found the end");
  const std::string_view header = in.rest().substr(0, in.rest().find_first_of(" \t"));
  // ST, C, N before OFF announce texture coordinates, colours and normals after the position.
  if (header.ends_with("OFF")) {
    const std::string_view prefix = in.word();
    if (prefix != "OFF" && prefix != "COFF" && prefix != "NOFF" && prefix != "CNOFF" && prefix != "STOFF" &&
        prefix != "STCNOFF" && prefix != "STNOFF" && prefix != "STCOFF")
      in.fail(fmt::format("'{}' is not supported (three-dimensional OFF is)", shown(prefix)));
    if (in.rest().find("BINARY") != std::string_view::npos) in.fail("binary OFF is not supported (text OFF is)");
    if (in.rest().find_first_not_of(" \t") == std::string_view::npos && !in.next_line('#'))
      in.fail("the counts are missing");
  } else if (header.find_first_not_of("0123456789") != std::string_view::npos) {
    in.fail(fmt::format("expected 'OFF', found '{}'", shown(header)));
  }
  const std::size_t num_vertices = count(in, "vertex count", kVertexBytes);
  const std::size_t num_faces = count(in, "face count", kFaceBytes);
  in.word();  // the edge count is not used and may be absent

  PolygonSoup soup;
  soup.vertices.reserve(num_vertices);
  for (std::size_t i = 0; i < num_vertices; ++i) {
    if (!in.next_line('#')) in.fail(fmt::format("the file ends after {} of {} vertices", i, num_vertices));
    soup.vertices.push_back({in.number("x"), in.number("y"), in.number("z")});
  }
  std::vector<int> polygon;
  for (std::size_t f = 0; f < num_faces; ++f) {
    if (!in.next_line('#')) in.fail(fmt::format("the file ends after {} of {} faces", f, num_faces));
    const std::int64_t size = in.integer("corner count");
    if (size < 0 || static_cast<std::uint64_t>(size) > in.rest().size())
      in.fail(fmt::format("corner count {} does not fit the line", size));
    polygon.clear();
    for (std::int64_t i = 0; i < size; ++i) {
      const std::int64_t index = in.integer("vertex index");
      if (index < 0 || index > std::numeric_limits<int>::max())
        in.fail(fmt::format("vertex index {} is out of range", index));
      polygon.push_back(static_cast<int>(index));
    }
    soup.add_polygon(polygon, in.line());
  }
  return soup;
}

}  // namespace tacipc
