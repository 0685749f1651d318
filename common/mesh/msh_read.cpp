#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <unordered_map>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/text_reader.h"
#include "common/mesh/msh_cursor.h"
#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"

namespace tacipc {
namespace {

enum class Keep { tet, triangle, nothing, refuse };

struct ElementType {
  int nodes;
  Keep keep;
  std::string_view name;
};

/// Returns the type for Gmsh's element numbers that occur in tetrahedral meshes, and for those that are refused by
/// name.
std::optional<ElementType> element_type(int number) {
  switch (number) {
    case 1: return ElementType{2, Keep::nothing, "line"};
    case 2: return ElementType{3, Keep::triangle, "triangle"};
    case 3: return ElementType{4, Keep::refuse, "quadrangle"};
    case 4: return ElementType{4, Keep::tet, "tetrahedron"};
    case 5: return ElementType{8, Keep::refuse, "hexahedron"};
    case 6: return ElementType{6, Keep::refuse, "prism"};
    case 7: return ElementType{5, Keep::refuse, "pyramid"};
    case 8: return ElementType{3, Keep::refuse, "3-node line"};
    case 9: return ElementType{6, Keep::refuse, "6-node triangle"};
    case 11: return ElementType{10, Keep::refuse, "10-node tetrahedron"};
    case 15: return ElementType{1, Keep::nothing, "point"};
    case 29: return ElementType{20, Keep::refuse, "20-node tetrahedron"};
    default: return std::nullopt;
  }
}

ElementType supported_type(const MshCursor& in, int number) {
  const std::optional<ElementType> type = element_type(number);
  if (!type) in.fail(fmt::format("element type {} is not supported (4-node tetrahedra, type 4, are)", number));
  if (type->keep == Keep::refuse)
    in.fail(fmt::format("{} (element type {}) is not supported (4-node tetrahedra, type 4, are)", type->name, number));
  return *type;
}

class MshReader {
 public:
  MshReader(std::string_view file, std::string name) : file_(file), name_(std::move(name)) { read_format(); }

  MshContent read() {
    for (std::size_t at = 0; const auto section = next_section(at);) {
      if (section->name == "Entities" && is_4_) read_entities(section->body);
      if (section->name == "Nodes") is_4_ ? read_nodes_4(section->body) : read_nodes_2(section->body);
      if (section->name == "Elements") is_4_ ? read_elements_4(section->body) : read_elements_2(section->body);
    }
    if (points_.empty()) throw DataError("{}: has no nodes", name_);
    if (tets_.empty()) throw DataError("{}: has no tetrahedra", name_);
    MshContent content;
    content.positions = rows_of<Positions>(points_);
    content.tets = Eigen::Map<const Tetrahedra>(tets_.data(), tets_.size() / 4, 4);
    content.triangles.resize(triangles_.size() / 3, 3);
    std::ranges::copy(triangles_, content.triangles.data());
    content.triangle_tags = std::move(triangle_tags_);
    return content;
  }

 private:
  struct Section {
    std::string name;
    std::string_view body;
  };

  /// Finds `$Name`, its body and `$EndName`; the body begins after the line end.
  std::optional<Section> next_section(std::size_t& at) const {
    const std::size_t dollar = file_.find('$', at);
    if (dollar == std::string_view::npos) return std::nullopt;
    const std::size_t line_end = file_.find('\n', dollar);
    if (line_end == std::string_view::npos) throw DataError("{}: the file ends at '$' at byte {}", name_, dollar);
    std::string name(file_.substr(dollar + 1, line_end - dollar - 1));
    while (!name.empty() && (name.back() == '\r' || name.back() == ' ')) name.pop_back();
    const std::string end_mark = "$End" + name;
    const std::size_t end = file_.find(end_mark, line_end);
    if (end == std::string_view::npos)
      throw DataError("{}: section ${} has no {} (the file is cut off or corrupt)", name_, shown(name),
                      shown(end_mark));
    at = end + end_mark.size();
    return Section{name, file_.substr(line_end + 1, end - line_end - 1)};
  }

  void read_format() {
    const std::size_t first = std::min(file_.find_first_not_of(" \t\r\n"), file_.size());
    if (!file_.substr(first).starts_with("$")) {
      const std::string_view line = file_.substr(first, file_.find_first_of("\r\n", first) - first);
      const bool is_inp = line.starts_with("*");
      throw DataError("{}: is not a Gmsh file: it begins with '{}'{}, not with $MeshFormat", name_, shown(line),
                      is_inp ? " (an Abaqus or CalculiX input?)" : "");
    }
    std::size_t at = 0;
    const std::optional<Section> section = next_section(at);
    if (section->name != "MeshFormat")
      throw DataError("{}: the first section is ${}, not $MeshFormat", name_, shown(section->name));
    TextReader in(section->body, name_, 2);
    const std::string version(in.word_anywhere());
    const std::int64_t binary = in.integer_anywhere("file type");
    const std::int64_t data_size = in.integer_anywhere("data size");
    is_4_ = version == "4.1";
    if (!is_4_ && version != "2" && version != "2.0" && version != "2.1" && version != "2.2")
      in.fail(fmt::format("MSH version '{}' is not supported (2.2 and 4.1 are)", shown(version)));
    if ((binary != 0 && binary != 1) || data_size != 8)
      in.fail(fmt::format("file type {} with data size {} is not supported (0 or 1 with 8 is)", binary, data_size));
    if (binary == 0) return;
    const std::size_t line_end = std::min(section->body.find('\n'), section->body.size() - 1);
    ByteReader bytes(section->body.substr(line_end + 1), name_);
    const auto one = bytes.read<std::uint32_t>("the byte-order mark");
    if (one != 1 && one != 0x01000000) throw DataError("{}: the byte-order mark is {}, not 1", name_, one);
    form_ = one == 1 ? MshCursor::Form::binary_little : MshCursor::Form::binary_big;
  }

  void add_node(const MshCursor& in, std::uint64_t number, const Vector3& point) {
    if (!point.allFinite()) throw DataError("{}: vertex {} is not finite", name_, points_.size());
    if (!index_of_node_.try_emplace(number, static_cast<int>(points_.size())).second)
      in.fail(fmt::format("node {} is defined twice", number));
    points_.push_back(point);
  }

  void add_element(const MshCursor& in, const ElementType& type, const std::array<std::uint64_t, 4>& nodes, int tag) {
    if (type.keep != Keep::tet && type.keep != Keep::triangle) return;
    std::vector<int>& corners = type.keep == Keep::tet ? tets_ : triangles_;
    for (int i = 0; i < type.nodes; ++i) {
      const auto found = index_of_node_.find(nodes[i]);
      if (found == index_of_node_.end())
        in.fail(fmt::format("a {} refers to node {}, which is not defined", type.name, nodes[i]));
      corners.push_back(found->second);
    }
    if (type.keep == Keep::triangle) triangle_tags_.push_back(tag);
  }

  void read_nodes_2(std::string_view body) {
    MshCursor in(file_, body, name_, form_);
    const std::uint64_t count = in.text_count("node count");
    in.check_fits(count, 4, 28, "nodes");
    for (std::uint64_t i = 0; i < count; ++i) {
      const int number = in.integer("node number");
      add_node(in, static_cast<std::uint64_t>(static_cast<std::int64_t>(number)),
               {in.real("x"), in.real("y"), in.real("z")});
    }
  }

  void read_elements_2(std::string_view body) {
    MshCursor in(file_, body, name_, form_);
    const std::uint64_t count = in.text_count("element count");
    in.check_fits(count, 4, 8, "elements");
    for (std::uint64_t done = 0; done < count;) {
      if (in.is_text()) in.integer("element number");
      const ElementType type = supported_type(in, in.integer("element type"));
      // Binary files give type and tag count once per run of elements.
      const int run = in.is_text() ? 1 : in.integer("element run length");
      const int num_tags = in.integer("tag count");
      if (run < 1 || static_cast<std::uint64_t>(run) > count - done || num_tags < 0)
        in.fail(
            fmt::format("{} elements with {} tags do not fit ({} of {} elements read)", run, num_tags, done, count));
      for (int i = 0; i < run; ++i) {
        if (!in.is_text()) in.integer("element number");
        const int tag = num_tags > 0 ? in.integer("physical tag") : 0;
        if (num_tags > 1) in.skip_integers(static_cast<std::uint64_t>(num_tags - 1), "tags");
        std::array<std::uint64_t, 4> nodes{};
        for (int n = 0; n < type.nodes; ++n)
          nodes[n] = static_cast<std::uint64_t>(static_cast<std::int64_t>(in.integer("node number")));
        add_element(in, type, nodes, tag);
      }
      done += static_cast<std::uint64_t>(run);
    }
  }

  /// Reads entities. Physical tags belong to geometric entities; stores the first tag of each surface.
  void read_entities(std::string_view body) {
    MshCursor in(file_, body, name_, form_);
    std::array<std::uint64_t, 4> counts;
    for (std::uint64_t& count : counts) count = in.size("entity count");
    for (int dim = 0; dim < 4; ++dim)
      for (std::uint64_t i = 0; i < counts[dim]; ++i) {
        const int entity = in.integer("entity tag");
        in.skip_reals(dim == 0 ? 3 : 6, "entity bounds");
        const std::uint64_t num_physical = in.size("physical tag count");
        if (num_physical > 0) {
          const int tag = in.integer("physical tag");
          if (dim == 2) physical_of_surface_[entity] = tag;
          in.skip_integers(num_physical - 1, "physical tags");
        }
        if (dim > 0) in.skip_integers(in.size("bounding entity count"), "bounding entities");
      }
  }

  void read_nodes_4(std::string_view body) {
    MshCursor in(file_, body, name_, form_);
    const std::uint64_t num_blocks = in.size("block count");
    const std::uint64_t count = in.size("node count");
    in.size("smallest node number");
    in.size("largest node number");
    in.check_fits(count, 4, 32, "nodes");
    std::vector<std::uint64_t> numbers;
    std::uint64_t done = 0;
    for (std::uint64_t b = 0; b < num_blocks; ++b) {
      const int dim = in.integer("entity dimension");
      in.integer("entity tag");
      const bool parametric = in.integer("parametric flag") != 0;
      const std::uint64_t size = in.size("block size");
      if (dim < 0 || dim > 3 || size > count - done)
        in.fail(fmt::format("{} nodes of dimension {} do not fit ({} of {} nodes read)", size, dim, done, count));
      numbers.resize(size);
      for (std::uint64_t& number : numbers) number = in.size("node number");
      for (const std::uint64_t number : numbers) {
        const double x = in.real("x"), y = in.real("y"), z = in.real("z");
        if (parametric) in.skip_reals(static_cast<std::uint64_t>(dim), "parameters");
        add_node(in, number, {x, y, z});
      }
      done += size;
    }
    if (done != count) in.fail(fmt::format("{} nodes announced, {} found", count, done));
  }

  void read_elements_4(std::string_view body) {
    MshCursor in(file_, body, name_, form_);
    const std::uint64_t num_blocks = in.size("block count");
    const std::uint64_t count = in.size("element count");
    in.size("smallest element number");
    in.size("largest element number");
    std::uint64_t done = 0;
    for (std::uint64_t b = 0; b < num_blocks; ++b) {
      const int dim = in.integer("entity dimension");
      const int entity = in.integer("entity tag");
      const ElementType type = supported_type(in, in.integer("element type"));
      const std::uint64_t size = in.size("block size");
      if (size > count - done)
        in.fail(fmt::format("{} elements do not fit ({} of {} elements read)", size, done, count));
      in.check_fits(size, 2, 16, "elements");
      const auto physical = physical_of_surface_.find(entity);
      const int tag = dim == 2 && physical != physical_of_surface_.end() ? physical->second : 0;
      for (std::uint64_t i = 0; i < size; ++i) {
        in.size("element number");
        std::array<std::uint64_t, 4> nodes{};
        for (int n = 0; n < type.nodes; ++n) nodes[n] = in.size("node number");
        add_element(in, type, nodes, tag);
      }
      done += size;
    }
    if (done != count) in.fail(fmt::format("{} elements announced, {} found", count, done));
  }

  std::string_view file_;
  std::string name_;
  bool is_4_ = false;
  MshCursor::Form form_ = MshCursor::Form::text;
  std::map<int, int> physical_of_surface_;
  std::unordered_map<std::uint64_t, int> index_of_node_;
  std::vector<Vector3> points_;
  std::vector<int> tets_;
  std::vector<int> triangles_;
  std::vector<int> triangle_tags_;
};

}  // namespace

MshContent read_msh(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  return MshReader(plain_text(bytes, path.string()), path.string()).read();
}

}  // namespace tacipc
