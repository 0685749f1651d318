#include "common/mesh/gltf_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/base/error.h"
#include "common/base/text_reader.h"
#include "common/mesh/glb_chunks.h"

namespace tacipc {
namespace {

using Json = nlohmann::json;

/// One object of the file, with its location for messages: `meshes[2].primitives[0]`.
class Section {
 public:
  Section(const Json& json, const std::string& name, std::string place)
      : json_(json), name_(name), place_(std::move(place)) {
    if (!json.is_object()) fail("is no object");
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw DataError("{}: {}{}{}", name_, place_, place_.empty() ? "" : " ", reason);
  }
  [[noreturn]] void fail(const char* key, const std::string& reason) const {
    throw DataError("{}: {}{}{} {}", name_, place_, place_.empty() ? "" : ".", key, reason);
  }

  const Json* find(const char* key) const {
    const auto found = json_.find(key);
    return found == json_.end() ? nullptr : &*found;
  }

  std::optional<std::size_t> optional_whole(const char* key) const {
    const Json* value = find(key);
    if (value == nullptr) return std::nullopt;
    return whole_of(*value, key);
  }
  std::size_t whole(const char* key) const {
    const auto value = optional_whole(key);
    if (!value) fail(key, "is missing");
    return *value;
  }
  /// Reads an index below `count`.
  std::optional<std::size_t> optional_index(const char* key, std::size_t count) const {
    const auto value = optional_whole(key);
    if (value) check_index(*value, key, count);
    return value;
  }
  std::size_t index(const char* key, std::size_t count) const {
    check_index(whole(key), key, count);
    return whole(key);
  }
  std::vector<std::size_t> indices(const char* key, std::size_t count) const {
    std::vector<std::size_t> list;
    for (const Json& item : items(key)) {
      list.push_back(whole_of(item, key));
      check_index(list.back(), key, count);
    }
    return list;
  }

  std::vector<double> numbers(const char* key) const {
    std::vector<double> list;
    for (const Json& item : items(key)) {
      if (!item.is_number() || !std::isfinite(item.get<double>())) fail(key, "has something else than numbers in it");
      list.push_back(item.get<double>());
    }
    return list;
  }

  std::string text(const char* key) const {
    const Json* value = find(key);
    if (value == nullptr) return "";
    if (!value->is_string()) fail(key, "is no text");
    return value->get<std::string>();
  }

  bool flag(const char* key) const {
    const Json* value = find(key);
    return value != nullptr && *value == true;
  }

  std::optional<Section> section(const char* key) const {
    const Json* value = find(key);
    if (value == nullptr) return std::nullopt;
    return Section(*value, name_, place_ + (place_.empty() ? "" : ".") + key);
  }
  std::vector<Section> sections(const char* key) const {
    std::vector<Section> list;
    for (const Json& item : items(key))
      list.emplace_back(item, name_, fmt::format("{}{}{}[{}]", place_, place_.empty() ? "" : ".", key, list.size()));
    return list;
  }
  /// Returns the elements of a list; empty if the key is absent.
  const Json& items(const char* key) const {
    static const Json kNone = Json::array();
    const Json* value = find(key);
    if (value == nullptr) return kNone;
    if (!value->is_array()) fail(key, "is no list");
    return *value;
  }

  const std::string& name() const { return name_; }
  const std::string& place() const { return place_; }

 private:
  std::size_t whole_of(const Json& value, const char* key) const {
    constexpr double kMost = 9007199254740992.0;  // doubles beyond this are not exact
    const double number = value.is_number() ? value.get<double>() : -1.0;
    if (!(number >= 0.0 && number <= kMost && number == std::floor(number))) fail(key, "is no whole number from 0");
    return static_cast<std::size_t>(number);
  }
  void check_index(std::size_t value, const char* key, std::size_t count) const {
    if (value >= count) fail(key, fmt::format("is {}, but there are {}", value, count));
  }

  const Json& json_;
  const std::string& name_;
  std::string place_;
};

/// Returns the number of elements in a list of the file.
std::size_t count_of(const Section& root, const char* key) { return root.items(key).size(); }

Json parsed(std::string_view text, const std::string& name) {
  text = text.substr(0, text.find_last_not_of(std::string_view(" \0", 2)) + 1);  // padding
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const Json::parse_error& error) {
    const std::string_view before = text.substr(0, error.byte == 0 ? 0 : error.byte - 1);
    const std::size_t line_end = before.rfind('\n');
    throw DataError("{}: is not glTF: no JSON from line {}, column {} on", name, 1 + std::ranges::count(before, '\n'),
                    line_end == std::string_view::npos ? before.size() + 1 : before.size() - line_end);
  } catch (const Json::out_of_range&) {
    throw DataError("{}: is not glTF: its JSON has a number that no double holds", name);
  }
}

/// Returns whether an extension changes no shape, or only in ways that this reader supports.
bool is_read(const std::string& extension) {
  constexpr std::array<std::string_view, 7> kKinds{"KHR_draco_mesh_compression",
                                                   "KHR_mesh_quantization",
                                                   "KHR_materials_",
                                                   "KHR_texture_",
                                                   "EXT_texture_",
                                                   "KHR_lights_",
                                                   "MSFT_texture_"};
  return std::ranges::any_of(kKinds, [&](std::string_view kind) { return extension.starts_with(kind); });
}

void check_version_and_extensions(const Section& root) {
  const auto asset = root.section("asset");
  if (!asset) root.fail("is not glTF: it has no 'asset'");
  const std::string version = asset->text("version"), least = asset->text("minVersion");
  if (!version.starts_with("2.") || !(least.empty() || least == "2.0"))
    root.fail("is glTF of version " + shown(least.empty() ? version : least) + "; version 2.0 is read");
  for (const Json& extension : root.items("extensionsRequired")) {
    const std::string word = extension.is_string() ? extension.get<std::string>() : "?";
    if (is_read(word)) continue;
    if (word.ends_with("_compression")) root.fail("is compressed (" + shown(word) + "); export it without compression");
    root.fail("requires the extension " + shown(word) + ", which is not read");
  }
}

std::string read_buffer(const Section& section, bool first, std::optional<std::string_view> binary) {
  const std::size_t length = section.whole("byteLength");
  const Json* uri = section.find("uri");
  if (uri == nullptr && !(first && binary)) section.fail("has no data in the file");
  std::string bytes =
      uri == nullptr ? std::string(*binary) : data_of_uri(section.text("uri"), section.name(), section.place());
  if (bytes.size() < length) section.fail(fmt::format("has {} bytes of {}", bytes.size(), length));
  bytes.resize(length);
  return bytes;
}

GltfView read_view(const Section& section, const std::vector<std::string>& buffers) {
  const GltfView view{.buffer = section.index("buffer", buffers.size()),
                      .offset = section.optional_whole("byteOffset").value_or(0),
                      .length = section.whole("byteLength"),
                      .stride = section.optional_whole("byteStride").value_or(0)};
  const std::size_t size = buffers[view.buffer].size();
  if (view.offset > size || view.length > size - view.offset)
    section.fail(fmt::format("reaches beyond the {} bytes of its buffer", size));
  return view;
}

GltfAccessor read_accessor(const Section& section, std::size_t views) {
  GltfAccessor accessor{.view = section.optional_index("bufferView", views),
                        .offset = section.optional_whole("byteOffset").value_or(0),
                        .count = section.whole("count"),
                        .component_type = static_cast<int>(std::min<std::size_t>(section.whole("componentType"), 9999)),
                        .type = section.text("type"),
                        .normalized = section.flag("normalized"),
                        .sparse = std::nullopt};
  const auto sparse = section.section("sparse");
  if (!sparse) return accessor;
  const auto indices = sparse->section("indices"), values = sparse->section("values");
  if (!indices || !values) sparse->fail("has no indices or no values");
  accessor.sparse = {.count = sparse->whole("count"),
                     .indices_view = indices->index("bufferView", views),
                     .indices_offset = indices->optional_whole("byteOffset").value_or(0),
                     .indices_type = static_cast<int>(std::min<std::size_t>(indices->whole("componentType"), 9999)),
                     .values_view = values->index("bufferView", views),
                     .values_offset = values->optional_whole("byteOffset").value_or(0)};
  return accessor;
}

/// Reads JOINTS_0 and WEIGHTS_0, JOINTS_1 …; indices are below `count`.
void read_sets(const Section& attributes, std::size_t count, std::vector<std::size_t>& joints,
               std::vector<std::size_t>& weights) {
  for (int set = 0;; ++set) {
    const auto joint = attributes.optional_index(fmt::format("JOINTS_{}", set).c_str(), count);
    const auto weight = attributes.optional_index(fmt::format("WEIGHTS_{}", set).c_str(), count);
    if (!joint || !weight) return;
    joints.push_back(*joint);
    weights.push_back(*weight);
  }
}

std::optional<GltfDraco> read_draco(const Section& primitive, std::size_t views) {
  const auto extensions = primitive.section("extensions");
  const auto section = extensions ? extensions->section("KHR_draco_mesh_compression") : std::nullopt;
  if (!section) return std::nullopt;
  const auto attributes = section->section("attributes");
  if (!attributes) section->fail("has no attributes");
  constexpr std::size_t kMostIds = std::size_t{1} << 32;
  GltfDraco draco{.view = section->index("bufferView", views),
                  .positions = attributes->index("POSITION", kMostIds),
                  .joints = {},
                  .weights = {}};
  read_sets(*attributes, kMostIds, draco.joints, draco.weights);
  return draco;
}

GltfPrimitive read_primitive(const Section& section, std::size_t accessors, std::size_t views) {
  GltfPrimitive primitive{
      .mode = static_cast<int>(std::min<std::size_t>(section.optional_whole("mode").value_or(4), 9)),
      .positions = std::nullopt,
      .indices = section.optional_index("indices", accessors),
      .joints = {},
      .weights = {},
      .morph = {},
      .draco = read_draco(section, views)};
  if (primitive.mode > 6) section.fail("mode", "is none of 0 … 6");
  if (const auto attributes = section.section("attributes")) {
    primitive.positions = attributes->optional_index("POSITION", accessors);
    read_sets(*attributes, accessors, primitive.joints, primitive.weights);
  }
  for (const Section& target : section.sections("targets"))
    primitive.morph.push_back(target.optional_index("POSITION", accessors));
  return primitive;
}

/// Reads a matrix, or a scale, followed by a rotation and a translation.
Eigen::Affine3d read_placement(const Section& section) {
  const auto numbers = [&](const char* key, std::size_t count) {
    const std::vector<double> list = section.numbers(key);
    if (list.size() != count) section.fail(key, fmt::format("has {} numbers, needs {}", list.size(), count));
    return list;
  };
  Eigen::Affine3d placement = Eigen::Affine3d::Identity();
  if (section.find("matrix") != nullptr) {
    const std::vector<double> m = numbers("matrix", 16);
    const Eigen::Map<const Matrix4> given(m.data());
    constexpr double kRounding = 1e-6;  // rounding of products in single precision
    if (!given.row(3).isApprox(Eigen::RowVector4d::UnitW(), kRounding))
      section.fail("matrix", "is no placement: its last row is not 0 0 0 1");
    placement.matrix().topRows<3>() = given.topRows<3>();
    return placement;
  }
  if (section.find("translation") != nullptr)
    placement.translation() = Eigen::Map<const Vector3>(numbers("translation", 3).data());
  if (section.find("rotation") != nullptr) {
    const std::vector<double> q = numbers("rotation", 4);
    const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
    if (!(turn.norm() > 0.0)) section.fail("rotation", "is no rotation");
    placement.linear() = turn.normalized().toRotationMatrix();
  }
  if (section.find("scale") != nullptr)
    placement.linear() *= Eigen::Map<const Vector3>(numbers("scale", 3).data()).asDiagonal();
  return placement;
}

GltfNode read_node(const Section& section, const GltfFile& file, std::size_t nodes) {
  const Json* extensions = section.find("extensions");
  if (extensions != nullptr && extensions->contains("EXT_mesh_gpu_instancing"))
    section.fail("has instances by EXT_mesh_gpu_instancing, which is not read");
  return {.mesh = section.optional_index("mesh", file.meshes.size()),
          .skin = section.optional_index("skin", file.skins.size()),
          .children = section.indices("children", nodes),
          .weights = section.numbers("weights"),
          .parent_from_node = read_placement(section)};
}

}  // namespace

GltfFile read_gltf_file(std::string_view bytes, const std::string& name) {
  const bool is_binary = bytes.starts_with("glTF");
  const GlbChunks chunks =
      is_binary ? glb_chunks(bytes, name) : GlbChunks{.json = plain_text(bytes, name), .binary = std::nullopt};
  const Json json = parsed(chunks.json, name);
  if (!json.is_object()) throw DataError("{}: is not glTF: its JSON is no object", name);
  const Section root(json, name, "");
  check_version_and_extensions(root);

  GltfFile file;
  for (const Section& buffer : root.sections("buffers"))
    file.buffers.push_back(read_buffer(buffer, file.buffers.empty(), chunks.binary));
  for (const Section& view : root.sections("bufferViews")) file.views.push_back(read_view(view, file.buffers));
  for (const Section& accessor : root.sections("accessors"))
    file.accessors.push_back(read_accessor(accessor, file.views.size()));
  for (const Section& mesh : root.sections("meshes")) {
    file.meshes.push_back({.primitives = {}, .weights = mesh.numbers("weights")});
    for (const Section& primitive : mesh.sections("primitives"))
      file.meshes.back().primitives.push_back(read_primitive(primitive, file.accessors.size(), file.views.size()));
  }
  const std::size_t nodes = count_of(root, "nodes");
  for (const Section& skin : root.sections("skins"))
    file.skins.push_back({.joints = skin.indices("joints", nodes),
                          .inverse_bind_matrices = skin.optional_index("inverseBindMatrices", file.accessors.size())});
  for (const Section& node : root.sections("nodes")) file.nodes.push_back(read_node(node, file, nodes));
  for (const Section& scene : root.sections("scenes")) file.scenes.push_back(scene.indices("nodes", nodes));
  file.scene = root.optional_index("scene", file.scenes.size());
  return file;
}

}  // namespace tacipc
