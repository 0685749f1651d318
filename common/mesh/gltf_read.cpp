// Reads the meshes of one glTF scene at their positions: nodes, skins and morph targets at rest.
#include <algorithm>
#include <deque>
#include <map>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/mesh/gltf_draco.h"
#include "common/mesh/gltf_file.h"
#include "common/mesh/gltf_numbers.h"
#include "common/mesh/scene_parts.h"

namespace tacipc {
namespace {

constexpr int kTriangles = 4, kStrip = 5, kFan = 6;

class Scene {
 public:
  Scene(GltfFile file, const std::string& name) : file_(std::move(file)), name_(name) {}

  TriangleMesh read() {
    place_nodes();
    for (std::size_t n = 0; n < file_.nodes.size(); ++n)
      if (scene_from_node_[n] && file_.nodes[n].mesh) add_mesh(n);
    return joined_parts(placed_, name_);
  }

 private:
  /// Returns the root nodes: of the displayed scene, else of the first scene; without scenes, the nodes that are no
  /// other node's children.
  std::vector<std::size_t> roots() const {
    if (!file_.scenes.empty()) {
      const std::size_t scene = file_.scene.value_or(0);
      if (file_.scenes.size() > 1)
        log_warning("{}: has {} scenes; number {} is read, {}", name_, file_.scenes.size(), scene + 1,
                    file_.scene ? "which the file shows" : "as the file names none");
      return file_.scenes[scene];
    }
    std::vector<bool> is_child(file_.nodes.size());
    for (const GltfNode& node : file_.nodes)
      for (const std::size_t child : node.children) is_child[child] = true;
    std::vector<std::size_t> tops;
    for (std::size_t n = 0; n < is_child.size(); ++n)
      if (!is_child[n]) tops.push_back(n);
    return tops;
  }

  /// Places the nodes. Nodes of a scene form trees: none is reached twice, so there are no cycles.
  void place_nodes() {
    scene_from_node_.resize(file_.nodes.size());
    std::vector<std::size_t> left = roots();
    for (const std::size_t root : left) place(root, Eigen::Affine3d::Identity());
    while (!left.empty()) {
      const std::size_t node = left.back();
      left.pop_back();
      for (const std::size_t child : file_.nodes[node].children) {
        place(child, *scene_from_node_[node]);
        left.push_back(child);
      }
    }
  }
  void place(std::size_t node, const Eigen::Affine3d& scene_from_parent) {
    if (scene_from_node_[node]) throw DataError("{}: nodes[{}] is in the scene twice, or below itself", name_, node);
    scene_from_node_[node] = scene_from_parent * file_.nodes[node].parent_from_node;
  }

  void add_mesh(std::size_t n) {
    const GltfNode& node = file_.nodes[n];
    const GltfMesh& mesh = file_.meshes[*node.mesh];
    // A mesh that is equal at all of its positions is stored once.
    const bool is_shared = !node.skin && node.weights.empty();
    if (const auto found = shared_.find(*node.mesh); is_shared && found != shared_.end()) {
      for (const PartMesh* part : found->second) placed_.push_back({part, *scene_from_node_[n]});
      return;
    }
    for (const GltfPrimitive& listed : mesh.primitives) {
      if (listed.mode < kTriangles || !(listed.positions || listed.draco)) continue;
      const GltfPrimitive primitive = listed.draco ? decompressed(listed, file_, name_) : listed;
      parts_.push_back(read_part(primitive, node.weights.empty() ? mesh.weights : node.weights));
      if (node.skin) bend(file_.skins[*node.skin], primitive, n, parts_.back());
      // A skin places its mesh in the scene by itself.
      placed_.push_back({&parts_.back(), node.skin ? Eigen::Affine3d::Identity() : *scene_from_node_[n]});
      if (is_shared) shared_[*node.mesh].push_back(&parts_.back());
    }
  }

  PartMesh read_part(const GltfPrimitive& primitive, const std::vector<double>& weights) {
    PartMesh part;
    const GltfNumbers positions(file_, *primitive.positions, "VEC3", name_);
    if (!positions.has_data()) throw DataError("{}: accessors[{}] has no positions in it", name_, *primitive.positions);
    if ((vertices_ += positions.count()) > kMostSceneElements)
      throw DataError("{}: has more than {} vertices", name_, kMostSceneElements);
    part.vertices.reserve(positions.count());
    for (std::size_t v = 0; v < positions.count(); ++v) part.vertices.push_back(positions.vector(v));
    for (std::size_t t = 0; t < std::min(primitive.morph.size(), weights.size()); ++t) {
      if (!primitive.morph[t] || weights[t] == 0.0) continue;
      const GltfNumbers moved(file_, *primitive.morph[t], "VEC3", name_);
      require_count(moved, part, "displacements of a morph target");
      for (std::size_t v = 0; v < moved.count(); ++v) part.vertices[v] += weights[t] * moved.vector(v);
    }
    read_triangles(primitive, part);
    return part;
  }

  void require_count(const GltfNumbers& numbers, const PartMesh& part, const char* what) const {
    if (numbers.count() != part.vertices.size())
      throw DataError("{}: has {} {} for {} vertices", name_, numbers.count(), what, part.vertices.size());
  }

  void read_triangles(const GltfPrimitive& primitive, PartMesh& part) {
    std::optional<GltfNumbers> indices;
    if (primitive.indices) indices.emplace(file_, *primitive.indices, "SCALAR", name_);
    if (indices && !indices->has_data())
      throw DataError("{}: accessors[{}] has no indices in it", name_, *primitive.indices);
    const std::size_t count = indices ? indices->count() : part.vertices.size();
    if ((triangles_ += primitive.mode == kTriangles ? count / 3 : count) > kMostSceneElements)
      throw DataError("{}: has more than {} triangles", name_, kMostSceneElements);
    const auto corner = [&](std::size_t i) {
      const double index = indices ? indices->at(i, 0) : static_cast<double>(i);
      if (!(index >= 0.0 && index < static_cast<double>(part.vertices.size())))
        throw DataError("{}: accessors[{}] names the vertex {} of {} (counted from 0)", name_, *primitive.indices,
                        index, part.vertices.size());
      return static_cast<int>(index);
    };
    if (primitive.mode == kTriangles) {
      if (count % 3 != 0) throw DataError("{}: has {} corners of triangles, no multiple of 3", name_, count);
      for (std::size_t i = 0; i < count; i += 3) part.triangles.emplace_back(corner(i), corner(i + 1), corner(i + 2));
    }
    for (std::size_t i = 2; primitive.mode == kFan && i < count; ++i)
      part.triangles.emplace_back(corner(i - 1), corner(i), corner(0));
    for (std::size_t i = 2; primitive.mode == kStrip && i < count; ++i)  // every other triangle is reversed
      part.triangles.emplace_back(corner(i - 2), corner(i % 2 == 0 ? i - 1 : i), corner(i % 2 == 0 ? i : i - 1));
  }

  /// Moves each vertex as its joints have moved from their bind pose: Σ w T_joint B_joint v.
  void bend(const GltfSkin& skin, const GltfPrimitive& primitive, std::size_t node, PartMesh& part) const {
    if (primitive.joints.empty())
      throw DataError("{}: nodes[{}] has a skin, but its mesh no joints and weights", name_, node);
    std::optional<GltfNumbers> inverse;
    if (skin.inverse_bind_matrices) inverse.emplace(file_, *skin.inverse_bind_matrices, "MAT4", name_);
    if (inverse && inverse->count() < skin.joints.size())
      throw DataError("{}: a skin has {} matrices for {} joints", name_, inverse->count(), skin.joints.size());
    std::vector<Eigen::Affine3d> moved;
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
      if (!scene_from_node_[skin.joints[j]])
        throw DataError("{}: nodes[{}], a joint of a skin, is not in the scene", name_, skin.joints[j]);
      Eigen::Affine3d from_bound = *scene_from_node_[skin.joints[j]];
      if (inverse) {
        Eigen::Affine3d bound = Eigen::Affine3d::Identity();
        for (std::size_t i = 0; i < 16; ++i)
          if (i % 4 < 3) bound.matrix()(static_cast<int>(i % 4), static_cast<int>(i / 4)) = inverse->at(j, i);
        from_bound = from_bound * bound;
      }
      moved.push_back(from_bound);
    }
    std::vector<Vector3> bent(part.vertices.size(), Vector3::Zero());
    for (std::size_t set = 0; set < primitive.joints.size(); ++set) {
      const GltfNumbers joints(file_, primitive.joints[set], "VEC4", name_);
      const GltfNumbers weights(file_, primitive.weights[set], "VEC4", name_);
      require_count(joints, part, "joints");
      require_count(weights, part, "weights");
      for (std::size_t v = 0; v < bent.size(); ++v)
        for (std::size_t k = 0; k < 4; ++k) {
          const double weight = weights.at(v, k), joint = joints.at(v, k);
          if (weight == 0.0) continue;
          if (!(joint >= 0.0 && joint < static_cast<double>(moved.size())))
            throw DataError("{}: vertex {} follows the joint {} of {} (counted from 0)", name_, v, joint, moved.size());
          bent[v] += weight * (moved[static_cast<std::size_t>(joint)] * part.vertices[v]);
        }
    }
    part.vertices = std::move(bent);
  }

  GltfFile file_;
  const std::string& name_;
  std::vector<std::optional<Eigen::Affine3d>> scene_from_node_;
  std::deque<PartMesh> parts_;  // deque, so that addresses stay valid
  std::map<std::size_t, std::vector<const PartMesh*>> shared_;
  std::vector<PlacedPart> placed_;
  std::size_t vertices_ = 0, triangles_ = 0;  // numbers read so far
};

}  // namespace

SceneMesh read_gltf(std::string_view bytes, const std::string& name) {
  return {.mesh = Scene(read_gltf_file(bytes, name), name).read(), .unit = "m"};
}

}  // namespace tacipc
