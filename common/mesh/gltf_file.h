// A glTF 2.0 file as it is written: nodes, meshes, skins, and the numbers that they name.   [ISO/IEC 12113]
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

// Types of components of an accessor.
inline constexpr int kGltfByte = 5120, kGltfUnsignedByte = 5121, kGltfShort = 5122, kGltfUnsignedShort = 5123,
                     kGltfUnsignedInt = 5125, kGltfFloat = 5126;

struct GltfView {
  std::size_t buffer, offset, length;
  std::size_t stride;  // from one element to the next; 0: they are packed
};

/// Elements of an accessor that differ from those of its view.
struct GltfSparse {
  std::size_t count;
  std::size_t indices_view, indices_offset;
  int indices_type;
  std::size_t values_view, values_offset;
};

struct GltfAccessor {
  std::optional<std::size_t> view;  // without one, zeros
  std::size_t offset, count;
  int component_type;  // one of these
  std::string type;    // SCALAR, VEC3, …
  bool normalized;
  std::optional<GltfSparse> sparse;
};

/// Where a primitive lies compressed, and the numbers of its attributes there.
struct GltfDraco {
  std::size_t view, positions;
  std::vector<std::size_t> joints, weights;
};

struct GltfPrimitive {
  int mode;  // 4: triangles, 5: a strip, 6: a fan, below: points and lines
  std::optional<std::size_t> positions, indices;
  std::vector<std::size_t> joints, weights;       // JOINTS_0, JOINTS_1, …
  std::vector<std::optional<std::size_t>> morph;  // displacements of each target
  std::optional<GltfDraco> draco;
};

struct GltfMesh {
  std::vector<GltfPrimitive> primitives;
  std::vector<double> weights;  // of morph targets
};

struct GltfSkin {
  std::vector<std::size_t> joints;  // nodes
  std::optional<std::size_t> inverse_bind_matrices;
};

struct GltfNode {
  std::optional<std::size_t> mesh, skin;
  std::vector<std::size_t> children;
  std::vector<double> weights;  // of morph targets, instead of the mesh's
  Eigen::Affine3d parent_from_node;
};

struct GltfFile {
  std::vector<std::string> buffers;
  std::vector<GltfView> views;
  std::vector<GltfAccessor> accessors;
  std::vector<GltfMesh> meshes;
  std::vector<GltfSkin> skins;
  std::vector<GltfNode> nodes;
  std::vector<std::vector<std::size_t>> scenes;  // root nodes of each
  std::optional<std::size_t> scene;              // that is shown
};

/// A .glb or .gltf file; its indices are of things that there are. \throw DataError `NAME: …` for another version,
/// buffers outside of the file, extensions that change shapes, and what breaks the format's rules.
GltfFile read_gltf_file(std::string_view bytes, const std::string& name);

}  // namespace tacipc
