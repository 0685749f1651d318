#include <algorithm>
#include <array>
#include <limits>

#include "common/base/error.h"
#include "common/base/text_reader.h"
#include "common/mesh/mesh_formats.h"

namespace tacipc {
namespace {

/// Statements without a surface, or about its appearance only.
constexpr std::array<std::string_view, 32> kIgnored{
    "vt",   "vn",   "vp",    "g",     "s",        "o",        "mg",         "usemtl",    "mtllib", "usemap", "maplib",
    "l",    "p",    "lod",   "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj", "cstype", "deg",    "bmat",
    "step", "curv", "curv2", "surf",  "parm",     "trim",     "hole",       "scrv",      "sp",     "end"};

/// Returns the vertex index in `12`, `12/3`, `12//4` or `12/3/4`; `-1` is the last defined vertex.
int vertex_index(const TextReader& in, std::string_view corner, std::size_t num_vertices) {
  const std::size_t slash = std::min(corner.find('/'), corner.size());
  const std::int64_t number = in.to_integer(corner.substr(0, slash), "vertex index");
  std::string_view others = corner.substr(slash);
  for (int i = 0; i < 2 && !others.empty(); ++i) {
    others.remove_prefix(1);
    const std::size_t end = std::min(others.find('/'), others.size());
    if (end > 0) in.to_integer(others.substr(0, end), "texture or normal index");
    others.remove_prefix(end);
  }
  if (!others.empty()) in.fail(fmt::format("'{}' is not a face corner", shown(corner)));
  if (number == 0) in.fail("vertex index 0 (OBJ counts from 1)");
  const std::int64_t index = number > 0 ? number - 1 : static_cast<std::int64_t>(num_vertices) + number;
  if (index < 0) in.fail(fmt::format("vertex index {}, but only {} vertices came before", number, num_vertices));
  if (index >= std::numeric_limits<int>::max()) in.fail(fmt::format("vertex index {} is too large", number));
  return static_cast<int>(index);
}

}  // namespace

PolygonSoup read_obj(std::string_view bytes, const std::string& name) {
  TextReader in(plain_text(bytes, name), name);
  PolygonSoup soup;
  std::vector<int> polygon;
  while (in.next_line('#')) {
    in.join_continued();
    const std::string_view statement = in.word();
    if (statement == "v") {
      soup.vertices.push_back({in.number("x"), in.number("y"), in.number("z")});  // a weight or a colour may follow
    } else if (statement == "f" || statement == "fo") {
      polygon.clear();
      for (std::string_view corner = in.word(); !corner.empty(); corner = in.word())
        polygon.push_back(vertex_index(in, corner, soup.vertices.size()));
      soup.add_polygon(polygon, in.line());
    } else if (std::ranges::find(kIgnored, statement) == kIgnored.end()) {
      in.fail(fmt::format("'{}' is not an OBJ statement", shown(statement)));
    }
  }
  return soup;
}

}  // namespace tacipc
