// Contents of a glTF 2.0 file: nodes, meshes, skins, and their arrays.   [ISO/IEC 12113]
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

// Component types of an accessor.
inline constexpr int kGltfByte = 5120, kGltfUnsignedByte = 5121, kGltfShort = 5122, kGltfUnsignedShort = 5123,
                     kGltfUnsignedInt = 5125, kGltfFloat = 5126;

/// Part of a buffer, bytes.
struct GltfView {
  std::size_t buffer, offset, length;
  std::size_t stride;  // bytes from one element to the next; 0: packed
};

/// Elements of an accessor that replace those of its view.
struct GltfSparse {
  std::size_t count;
  std::size_t indices_view, indices_offset;
  int indices_type;
  std::size_t values_view, values_offset;
};

/// Declaration of an array of numbers.
struct GltfAccessor {
  std::optional<std::size_t> view;  // absent: all elements are zero
  std::size_t offset, count;
  int component_type;  // one of the component types above
  std::string type;    // SCALAR, VEC3, …
  bool normalized;
  std::optional<GltfSparse> sparse;
};

/// Compressed form of a primitive: its view, and the Draco identifiers of its attributes.
struct GltfDraco {
  std::size_t view, positions;
  std::vector<std::size_t> joints, weights;
};

/// Part of a mesh: its topology, and the accessors of its attributes.
struct GltfPrimitive {
  int mode;  // 4: triangles, 5: a strip, 6: a fan, smaller: points and lines
  std::optional<std::size_t> positions, indices;
  std::vector<std::size_t> joints, weights;       // JOINTS_0, JOINTS_1, …
  std::vector<std::optional<std::size_t>> morph;  // displacements of each morph target
  std::optional<GltfDraco> draco;
};

/// A mesh: primitives with common morph weights.
struct GltfMesh {
  std::vector<GltfPrimitive> primitives;
  std::vector<double> weights;  // weights of morph targets
};

/// Joints that deform a mesh.
struct GltfSkin {
  std::vector<std::size_t> joints;  // indices of nodes
  std::optional<std::size_t> inverse_bind_matrices;
};

/// A node of the scene graph; numbers are indices into the file's lists.
struct GltfNode {
  std::optional<std::size_t> mesh, skin;
  std::vector<std::size_t> children;
  std::vector<double> weights;  // weights of morph targets that replace the mesh's
  Eigen::Affine3d parent_from_node;
};

/// Contents of a file.
struct GltfFile {
  std::vector<std::string> buffers;
  std::vector<GltfView> views;
  std::vector<GltfAccessor> accessors;
  std::vector<GltfMesh> meshes;
  std::vector<GltfSkin> skins;
  std::vector<GltfNode> nodes;
  std::vector<std::vector<std::size_t>> scenes;  // root nodes of each scene
  std::optional<std::size_t> scene;              // index of the displayed scene
};

/// Reads a .glb or .gltf file. All indices of the result are valid.
/// \throw DataError `NAME: …` for another version, buffers outside the file, extensions that change shapes, and
/// violations of the format
GltfFile read_gltf_file(std::string_view bytes, const std::string& name);

}  // namespace tacipc
