#include "common/mesh/threemf_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <pugixml.hpp>
#include <sstream>

#include "common/base/error.h"
#include "common/base/parse.h"
#include "common/base/text_reader.h"

namespace tacipc {
namespace {

using Node = pugi::xml_node;

constexpr const char* kCore = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
constexpr const char* kProduction = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
// Namespaces about looks and names of triangles, which change no shape.
constexpr const char* kMaterials = "http://schemas.microsoft.com/3dmanufacturing/material/2015/02";
constexpr const char* kTriangleSets = "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07";
constexpr const char* kRootRelation = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

/// Memory limit of an XML tree; enough for some 15 million triangles.
constexpr std::size_t kMostTree = std::size_t{4} << 30;
constexpr std::size_t kNodeBytes = 64, kAttributeBytes = 40;

std::string_view prefix_of(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? std::string_view() : name.substr(0, colon);
}
std::string_view local_name(std::string_view name) { return name.substr(name.find(':') + 1); }

/// Returns the namespace of a prefix at an element; empty if it has none.
std::string namespace_of(Node node, std::string_view prefix) {
  const std::string wanted = prefix.empty() ? "xmlns" : "xmlns:" + std::string(prefix);
  for (; node; node = node.parent())
    if (const auto found = node.attribute(wanted.c_str())) return found.value();
  return "";
}

/// Returns an element as messages name it.
std::string element_text(Node node) {
  const std::string space = namespace_of(node, prefix_of(node.name()));
  return fmt::format("<{}>{}", shown(node.name()), space == kCore ? "" : " of " + shown(space));
}

/// Parses a document and returns its root element.
/// \throw DataError `PLACE: …` if it is not XML
Node parse(pugi::xml_document& document, std::string& xml, const std::string& place) {
  const auto count = [&](char c) { return static_cast<std::size_t>(std::ranges::count(xml, c)); };
  if (kNodeBytes * count('<') + kAttributeBytes * count('=') > kMostTree)
    throw DataError("{}: has too many elements to be held in memory", place);
  const pugi::xml_parse_result result = document.load_buffer_inplace(xml.data(), xml.size());
  if (!result) throw DataError("{}: is not XML ({} at byte {})", place, result.description(), result.offset);
  return document.document_element();
}

/// Reads one model; stores the location for messages.
class ModelReader {
 public:
  ModelReader(Node root, const std::string& place) : root_(root), place_(place), prefix_(prefix_of(root.name())) {
    if (!prefix_.empty()) prefix_ += ':';
  }

  ThreeMfModel read(ThreeMfBuild build_section) {
    if (local_name(root_.name()) != "model" || namespace_of(root_, prefix_of(root_.name())) != kCore)
      throw DataError("{}: its root element is {}, not <model> of {}", place_, element_text(root_), kCore);
    check_extensions();
    ThreeMfModel model;
    model.unit = unit();
    for_each(root_, "resources", [&](Node resources) {
      for_each(resources, "object", [&](Node object) {
        const int id = read_id(object, "id");
        if (!model.objects.try_emplace(id, read_object(object, id)).second)
          throw DataError("{}: has object {} twice", place_, id);
      });
    });
    if (build_section == ThreeMfBuild::ignore) return model;
    for_each(root_, "build", [&](Node build) {
      for_each(build, "item", [&](Node item) { model.items.push_back(read_reference(item)); });
    });
    return model;
  }

 private:
  std::string core(const char* name) const { return prefix_ + name; }
  bool is_core(Node node, const char* name) const { return core(name) == node.name(); }

  /// Calls `use` for children of this name in the core namespace.
  template <typename Use>
  void for_each(Node parent, const char* name, const Use& use) const {
    const std::string qualified = core(name);
    for (const Node child : parent.children(qualified.c_str())) use(child);
  }

  void check_extensions() const {
    std::istringstream prefixes(root_.attribute("requiredextensions").value());
    for (std::string prefix; prefixes >> prefix;) {
      const std::string space = namespace_of(root_, prefix);
      if (space != kProduction && space != kMaterials && space != kTriangleSets && space != kCore)
        throw DataError("{}: requires the extension '{}'{}, which is not read", place_, shown(prefix),
                        space.empty() ? "" : " (" + shown_space(space) + ")");
    }
  }
  static std::string shown_space(const std::string& space) {
    // The end of such a name identifies it.
    constexpr std::size_t kLongest = 38;
    return space.size() <= kLongest ? shown(space) : "…" + shown(space.substr(space.size() - kLongest));
  }

  std::optional<std::string> unit() const {
    if (!root_.attribute("unit")) return std::nullopt;
    const std::string word = root_.attribute("unit").value();
    for (const auto& [name, unit] : std::array<std::pair<const char*, const char*>, 6>{{{"micron", "um"},
                                                                                        {"millimeter", "mm"},
                                                                                        {"centimeter", "cm"},
                                                                                        {"inch", "in"},
                                                                                        {"foot", "ft"},
                                                                                        {"meter", "m"}}})
      if (word == name) return unit;
    throw DataError("{}: unit '{}' is none of micron, millimeter, centimeter, inch, foot, meter", place_, shown(word));
  }

  /// Reads the number in an attribute, which may have blanks around it and a plus before it.
  template <typename Number>
  static std::optional<Number> number(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n";
    text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
    text = text.substr(0, text.find_last_not_of(kBlanks) + 1);
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    return parse_number<Number>(text);
  }

  [[noreturn]] void refuse(Node node, const char* key, const char* what) const {
    throw DataError("{}: {} of {} is '{}', not {}", place_, key, element_text(node), shown(node.attribute(key).value()),
                    what);
  }

  int read_id(Node node, const char* key) const {
    const auto id = number<int>(node.attribute(key).value());
    if (!id || *id < 1) refuse(node, key, "a whole number from 1");
    return *id;
  }

  ThreeMfReference read_reference(Node node) const {
    ThreeMfReference reference{.object = read_id(node, "objectid"), .path = std::nullopt};
    for (const pugi::xml_attribute attribute : node.attributes()) {
      const std::string_view prefix = prefix_of(attribute.name());
      if (prefix.empty() || prefix == "xmlns" || local_name(attribute.name()) != "path") continue;
      if (namespace_of(node, prefix) != kProduction)
        throw DataError("{}: {} of {} is not the path of {}", place_, shown(attribute.name()), element_text(node),
                        kProduction);
      reference.path = attribute.value();
    }
    if (const auto transform = node.attribute("transform")) reference.placement = read_transform(node, transform);
    return reference;
  }

  /// Reads a 4 × 3 matrix in 3MF's convention: a point, as a row vector p, is mapped to p M.
  Eigen::Affine3d read_transform(Node node, pugi::xml_attribute transform) const {
    std::istringstream words(transform.value());
    std::array<double, 12> m{};
    std::size_t count = 0;
    for (std::string word; words >> word; ++count) {
      const auto value = number<double>(word);
      if (count == m.size() || !value || !std::isfinite(*value)) refuse(node, "transform", "12 numbers");
      m[count] = *value;
    }
    if (count != m.size()) refuse(node, "transform", "12 numbers");
    Eigen::Affine3d placement = Eigen::Affine3d::Identity();
    placement.linear() = Eigen::Map<const Eigen::Matrix3d>(m.data());  // column by column: transposed
    placement.translation() = Eigen::Map<const Vector3>(m.data() + 9);
    if (placement.linear().determinant() == 0.0) refuse(node, "transform", "invertible");
    return placement;
  }

  ThreeMfObject read_object(Node node, int id) const {
    ThreeMfObject object;
    object.type = node.attribute("type").as_string("model");
    constexpr std::array<std::string_view, 5> kTypes{"model", "solidsupport", "support", "surface", "other"};
    if (std::ranges::find(kTypes, object.type) == kTypes.end())
      refuse(node, "type", "model, solidsupport, support, surface or other");
    for (const pugi::xml_attribute attribute : node.attributes()) {
      const std::string_view name = local_name(attribute.name());
      if ((name == "meshresolution" || name == "modelresolution") && attribute.value() != std::string_view("fullres"))
        object.unread = fmt::format("is {} by its {}: it stands in for another shape", shown(attribute.value()),
                                    shown(attribute.name()));
    }
    bool has_shape = false;
    for (const Node child : node.children()) {
      if (child.type() != pugi::node_element || is_core(child, "metadatagroup") ||
          local_name(child.name()) == "alternatives")
        continue;
      const bool is_mesh = is_core(child, "mesh");
      if (!is_mesh && !is_core(child, "components")) {
        object.unread = fmt::format("has {}, which is not read", element_text(child));
        has_shape = true;
        continue;
      }
      if (has_shape) throw DataError("{}: object {} has more than one mesh or list of components", place_, id);
      has_shape = true;
      if (is_mesh)
        read_mesh(child, object, id);
      else
        for_each(child, "component", [&](Node component) { object.components.push_back(read_reference(component)); });
    }
    if (!has_shape) object.unread = "has neither a mesh nor components";
    return object;
  }

  void read_mesh(Node mesh, ThreeMfObject& object, int id) const {
    for (const Node child : mesh.children()) {
      if (child.type() != pugi::node_element) continue;
      if (is_core(child, "vertices"))
        read_vertices(child, object.mesh, id);
      else if (!is_core(child, "triangles") && namespace_of(child, prefix_of(child.name())) != kTriangleSets)
        object.unread = fmt::format("has {}, which is not read", element_text(child));
    }
    for_each(mesh, "triangles", [&](Node triangles) { read_triangles(triangles, object.mesh, id); });
  }

  void read_vertices(Node vertices, PartMesh& mesh, int id) const {
    for_each(vertices, "vertex", [&](Node vertex) {
      Vector3 point;
      for (int axis = 0; axis < 3; ++axis) {
        const char name[] = {"xyz"[axis], '\0'};
        const auto value = number<double>(vertex.attribute(name).value());
        if (!value || !std::isfinite(*value))
          throw DataError("{}: object {}: {} of vertex {} is '{}', not a number", place_, id, name,
                          mesh.vertices.size(), shown(vertex.attribute(name).value()));
        point[axis] = *value;
      }
      mesh.vertices.push_back(point);
    });
  }

  void read_triangles(Node triangles, PartMesh& mesh, int id) const {
    for_each(triangles, "triangle", [&](Node triangle) {
      Eigen::Vector3i corners;
      for (int corner = 0; corner < 3; ++corner) {
        constexpr std::array<const char*, 3> kNames{"v1", "v2", "v3"};
        const char* const text = triangle.attribute(kNames[static_cast<std::size_t>(corner)]).value();
        const auto vertex = number<std::uint32_t>(text);
        if (!vertex || *vertex >= mesh.vertices.size())
          throw DataError("{}: object {}: triangle {} names the vertex '{}' of {} (counted from 0)", place_, id,
                          mesh.triangles.size(), shown(text), mesh.vertices.size());
        corners[corner] = static_cast<int>(*vertex);
      }
      mesh.triangles.push_back(corners);
    });
  }

  Node root_;
  const std::string& place_;
  std::string prefix_;  // prefix of the core namespace, with its colon
};

}  // namespace

std::string root_part_of(std::string relationships, const std::string& place) {
  pugi::xml_document document;
  const Node root = parse(document, relationships, place);
  for (const Node relation : root.children()) {
    if (local_name(relation.name()) != "Relationship") continue;
    if (relation.attribute("Type").value() != std::string_view(kRootRelation)) continue;
    if (relation.attribute("TargetMode").value() == std::string_view("External"))
      throw DataError("{}: the root model lies outside of the archive", place);
    return relation.attribute("Target").value();
  }
  throw DataError("{}: names no root model", place);
}

ThreeMfModel read_threemf_model(std::string xml, const std::string& place, ThreeMfBuild build) {
  pugi::xml_document document;
  return ModelReader(parse(document, xml, place), place).read(build);
}

std::string volumes_that_are_no_parts(std::string settings, const std::string& place) {
  pugi::xml_document document;
  Node root;
  try {
    root = parse(document, settings, place);
  } catch (const DataError&) {
    return "";  // settings of another program, without shapes
  }
  std::string kinds;
  for (const Node object : root.children("object"))
    for (const Node volume : object.children("volume"))
      for (const Node metadata : volume.children("metadata")) {
        const std::string kind = shown(metadata.attribute("value").value());
        if (metadata.attribute("key").value() != std::string_view("volume_type") || kind == "ModelPart") continue;
        if (kinds.size() < 100 && kinds.find(kind) == std::string::npos) kinds += (kinds.empty() ? "" : ", ") + kind;
      }
  return kinds;
}

}  // namespace tacipc
