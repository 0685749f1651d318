#include "common/mesh/gltf_draco.h"

#include <draco/compression/decode.h>

#include <memory>
#include <new>

#include "common/base/error.h"
#include "common/base/text_reader.h"
#include "common/mesh/scene_parts.h"

namespace tacipc {
namespace {

/// Adds an array to the file; returns the number of its accessor.
template <typename T>
std::size_t added(const std::vector<T>& values, std::size_t count, int component_type, const char* type,
                  GltfFile& file) {
  file.buffers.emplace_back(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  file.views.push_back(
      {.buffer = file.buffers.size() - 1, .offset = 0, .length = file.buffers.back().size(), .stride = 0});
  file.accessors.push_back({.view = file.views.size() - 1,
                            .offset = 0,
                            .count = count,
                            .component_type = component_type,
                            .type = type,
                            .normalized = false,
                            .sparse = std::nullopt});
  return file.accessors.size() - 1;
}

std::unique_ptr<draco::Mesh> decoded(std::string_view bytes, const std::string& name) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  try {
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok())
      throw DataError("{}: its Draco compression is damaged ({})", name, shown(mesh.status().error_msg_string()));
    return std::move(mesh).value();
  } catch (const std::bad_alloc&) {
    throw DataError("{}: its Draco compression asks for more memory than there is", name);
  }
}

/// Returns an attribute's values at all points, `components` each.
std::vector<float> values_of(const draco::Mesh& mesh, std::size_t id, int components, const std::string& name) {
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(static_cast<std::uint32_t>(id));
  if (attribute == nullptr || attribute->num_components() != components)
    throw DataError("{}: its Draco compression has no attribute {} of {} components", name, id, components);
  std::vector<float> values(static_cast<std::size_t>(mesh.num_points()) * static_cast<std::size_t>(components));
  for (std::uint32_t p = 0; p < mesh.num_points(); ++p) {
    const draco::AttributeValueIndex at = attribute->mapped_index(draco::PointIndex(p));
    if (!attribute->ConvertValue(at,
                                 values.data() + static_cast<std::size_t>(p) * static_cast<std::size_t>(components)))
      throw DataError("{}: its Draco compression has no value for point {}", name, p);
  }
  return values;
}

}  // namespace

GltfPrimitive decompressed(GltfPrimitive primitive, GltfFile& file, const std::string& name) {
  const GltfDraco& compressed = *primitive.draco;
  const GltfView view = file.views[compressed.view];
  const std::string_view bytes = std::string_view(file.buffers[view.buffer]).substr(view.offset, view.length);
  const std::unique_ptr<draco::Mesh> mesh = decoded(bytes, name);
  const std::size_t points = mesh->num_points();
  if (points > kMostSceneElements || mesh->num_faces() > kMostSceneElements)
    throw DataError("{}: has more than {} vertices or triangles", name, kMostSceneElements);
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * static_cast<std::size_t>(mesh->num_faces()));
  for (std::uint32_t f = 0; f < mesh->num_faces(); ++f)
    for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(f))) corners.push_back(corner.value());
  primitive.indices = added(corners, corners.size(), kGltfUnsignedInt, "SCALAR", file);
  primitive.mode = 4;  // decompression gives triangles, whatever the mode was
  primitive.positions = added(values_of(*mesh, compressed.positions, 3, name), points, kGltfFloat, "VEC3", file);
  for (auto [ids, accessors] :
       {std::pair{&compressed.joints, &primitive.joints}, {&compressed.weights, &primitive.weights}}) {
    if (ids->empty()) continue;
    accessors->clear();
    for (const std::size_t id : *ids)
      accessors->push_back(added(values_of(*mesh, id, 4, name), points, kGltfFloat, "VEC4", file));
  }
  return primitive;
}

}  // namespace tacipc
