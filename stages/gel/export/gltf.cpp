#include "stages/gel/export/gltf.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "common/base/error.h"
#include "common/base/json.h"
#include "common/base/tone_curve.h"
#include "common/image/picture.h"

namespace tacipc {
namespace {

// Numbers of the glTF 2.0 specification.
constexpr int kFloat = 5126, kUnsignedShort = 5123, kUnsignedInt = 5125;
constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;

/// Binary part of the file and its description, array by array.
class Buffer {
 public:
  /// Adds an array of rows. \param target use by the graphics card, 0 for none \return number of its accessor
  template <typename T>
  int add(const std::vector<T>& values, int components, int component_type, int target, bool bounds = false) {
    static_assert(std::endian::native == std::endian::little, "written as it lies in memory");
    constexpr const char* kTypes[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    Value view = Value::Map{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size() * sizeof(T)}};
    if (target != 0) view.set("target", target);
    Value accessor = Value::Map{{"bufferView", views_.size()},
                                {"componentType", component_type},
                                {"count", values.size() / static_cast<std::size_t>(components)},
                                {"type", kTypes[components]}};
    if (component_type == kUnsignedShort) accessor.set("normalized", true);
    if (bounds) add_bounds(accessor, values, static_cast<std::size_t>(components));
    views_.push_back(view);
    accessors_.push_back(accessor);
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    return static_cast<int>(accessors_.size()) - 1;
  }
  const Value::List& views() const { return views_; }
  const Value::List& accessors() const { return accessors_; }
  const std::string& bytes() const { return bytes_; }

 private:
  template <typename T>
  static void add_bounds(Value& accessor, const std::vector<T>& values, std::size_t components) {
    Value::List low, high;
    for (std::size_t c = 0; c < components; ++c) {
      T least = values[c], most = values[c];
      for (std::size_t i = c; i < values.size(); i += components) {
        least = std::min(least, values[i]);
        most = std::max(most, values[i]);
      }
      low.emplace_back(static_cast<double>(least));
      high.emplace_back(static_cast<double>(most));
    }
    accessor.set("min", low);
    accessor.set("max", high);
  }

  Value::List views_, accessors_;
  std::string bytes_;
};

std::vector<float> floats(const Positions& rows) { return {rows.data(), rows.data() + rows.size()}; }

/// Converts a colour channel of a screen to linear light, 16 bits, as glTF requires for colours of vertices [IEC
/// 61966-2-1].
std::uint16_t linear_channel(std::uint8_t code) {
  return static_cast<std::uint16_t>(std::lround(65535.0 * ToneCurve{}.value_of(code)));
}

/// Positions of the front of a gel in one frame.
Positions front_at(const OpenGel& gel, std::size_t frame) {
  return gel.press.positions(frame)(gel.press.front_vertices(), Eigen::all);
}

/// Indentation of the deepest vertex of all gels in the last frame, m.
double deepest_indentation(const OpenScene& scene) {
  double deepest = 1e-6;
  for (const OpenGel& gel : scene.gels) {
    const Positions rest = front_at(gel, 0), last = front_at(gel, scene.times_s.size() - 1);
    deepest = std::max(deepest, (rest.col(2) - last.col(2)).maxCoeff());
  }
  return deepest;
}

/// RGBA of the indentation, light at the deepest vertex.
std::vector<std::uint16_t> indentation_colors(const Positions& rest, const Positions& last, double deepest) {
  const Eigen::VectorXd depth = rest.col(2) - last.col(2);
  std::vector<std::uint16_t> colors;
  for (const double d : depth) {
    for (const std::uint8_t code : perceptual_color(d / deepest)) colors.push_back(linear_channel(code));
    colors.push_back(std::numeric_limits<std::uint16_t>::max());
  }
  return colors;
}

std::vector<std::uint32_t> corners(const Triangles& triangles, const std::vector<int>* of_vertices = nullptr) {
  std::vector<std::uint32_t> indices;
  for (const int v : std::span<const int>(triangles.data(), static_cast<std::size_t>(triangles.size()))) {
    const auto place = [&] {
      return std::lower_bound(of_vertices->begin(), of_vertices->end(), v) - of_vertices->begin();
    };
    indices.push_back(static_cast<std::uint32_t>(of_vertices ? place() : v));
  }
  return indices;
}

Value material(const char* name, Value::List color, double roughness) {
  return Value::Map{
      {"name", name},
      {"doubleSided", true},
      {"pbrMetallicRoughness",
       Value::Map{{"baseColorFactor", std::move(color)}, {"metallicFactor", 0.0}, {"roughnessFactor", roughness}}}};
}

std::string named(const char* kind, const std::string& name) {
  return name.empty() ? std::string(kind) : std::string(kind) + " " + name;
}

/// A mesh with a morph target per later frame. \param later displacement of each vertex in each later frame
Value morphing_mesh(const std::string& name, Value::Map attributes, int indices, int material,
                    const std::vector<Positions>& later, Buffer& buffer) {
  Value primitive = Value::Map{{"attributes", std::move(attributes)}, {"indices", indices}, {"material", material}};
  Value mesh = Value::Map{{"name", name}};
  Value::List targets;
  for (const Positions& moved : later)
    targets.emplace_back(Value::Map{{"POSITION", buffer.add(floats(moved), 3, kFloat, kVertexBuffer, true)}});
  if (!later.empty()) {
    mesh.set("weights", Value::List(later.size(), Value(0.0)));
    primitive.set("targets", targets);
  }
  mesh.set("primitives", Value::List{primitive});
  return mesh;
}

/// The front as a mesh with a morph target per later frame.
Value gel_mesh(const OpenGel& gel, std::size_t frames, double deepest, Buffer& buffer) {
  const std::vector<int> front = gel.press.front_vertices();
  const Positions rest = front_at(gel, 0), last = front_at(gel, frames - 1);
  const int positions = buffer.add(floats(rest), 3, kFloat, kVertexBuffer, true);
  const int colors = buffer.add(indentation_colors(rest, last, deepest), 4, kUnsignedShort, kVertexBuffer);
  const int indices = buffer.add(corners(gel.mesh.faces(BoundaryTag::front), &front), 1, kUnsignedInt, kIndexBuffer);
  std::vector<Positions> later;
  for (std::size_t f = 1; f < frames; ++f) later.emplace_back(front_at(gel, f) - rest);
  return morphing_mesh(named("gel", gel.name), Value::Map{{"POSITION", positions}, {"COLOR_0", colors}}, indices, 0,
                       later, buffer);
}

Value object_mesh(const OpenObject& object, Buffer& buffer) {
  const int positions = buffer.add(floats(object.mesh.positions), 3, kFloat, kVertexBuffer, true);
  const int indices = buffer.add(corners(object.mesh.triangles), 1, kUnsignedInt, kIndexBuffer);
  return morphing_mesh(named("object", object.name), Value::Map{{"POSITION", positions}}, indices, 1, {}, buffer);
}

/// The surface of a soft body as a mesh with a morph target per later frame.
Value soft_mesh(const OpenSoft& soft, Buffer& buffer) {
  const std::vector<int> surface = soft.mesh.vertices(BoundaryTag::free);
  const Positions first = soft.positions.front()(surface, Eigen::all);
  const int positions = buffer.add(floats(first), 3, kFloat, kVertexBuffer, true);
  const int indices = buffer.add(corners(soft.mesh.boundary, &surface), 1, kUnsignedInt, kIndexBuffer);
  std::vector<Positions> later;
  for (std::size_t f = 1; f < soft.positions.size(); ++f)
    later.emplace_back(soft.positions[f](surface, Eigen::all) - first);
  return morphing_mesh(named("soft", soft.name), Value::Map{{"POSITION", positions}}, indices, 2, later, buffer);
}

/// Quaternions x, y, z, w of the poses, with signs such that each rotation takes the shorter way.
std::vector<float> rotations(const std::vector<Matrix4>& poses) {
  std::vector<float> values;
  Eigen::Quaterniond before = Eigen::Quaterniond::Identity();
  for (const Matrix4& pose : poses) {
    Eigen::Quaterniond q(Matrix3(pose.topLeftCorner<3, 3>()));
    q.normalize();
    if (q.dot(before) < 0.0) q.coeffs() *= -1.0;
    before = q;
    for (const double c : q.coeffs()) values.push_back(static_cast<float>(c));
  }
  return values;
}

/// Animation of all nodes: 0 is the root, then gels, objects and soft bodies.
Value animation(const OpenScene& scene, Buffer& buffer) {
  const std::size_t frames = scene.times_s.size();
  std::vector<float> weights(frames * (frames - 1), 0.0F);
  for (std::size_t f = 1; f < frames; ++f) weights[f * (frames - 1) + f - 1] = 1.0F;
  const int time = buffer.add(std::vector<float>(scene.times_s.begin(), scene.times_s.end()), 1, kFloat, 0, true);
  Value::List samplers, channels;
  const auto play = [&](int output, std::size_t node, const char* path) {
    channels.emplace_back(
        Value::Map{{"sampler", samplers.size()}, {"target", Value::Map{{"node", node}, {"path", path}}}});
    samplers.emplace_back(Value::Map{{"input", time}, {"output", output}, {"interpolation", "LINEAR"}});
  };
  const auto play_poses = [&](const std::vector<Matrix4>& poses, std::size_t node) {
    std::vector<float> places;
    for (const Matrix4& pose : poses)
      for (int c = 0; c < 3; ++c) places.push_back(static_cast<float>(pose(c, 3)));
    play(buffer.add(places, 3, kFloat, 0), node, "translation");
    play(buffer.add(rotations(poses), 4, kFloat, 0), node, "rotation");
  };
  std::size_t node = 1;
  for (const OpenGel& gel : scene.gels) {
    play(buffer.add(weights, 1, kFloat, 0), node, "weights");
    if (!gel.world_from_gel.empty()) play_poses(gel.world_from_gel, node);
    ++node;
  }
  for (const OpenObject& object : scene.objects) play_poses(object.world_from_object, node++);
  for (std::size_t i = 0; i < scene.soft.size(); ++i) play(buffer.add(weights, 1, kFloat, 0), node++, "weights");
  return Value::Map{{"name", "press"}, {"samplers", samplers}, {"channels", channels}};
}

Value::List nodes(const OpenScene& scene) {
  Value::List nodes, children;
  const auto add = [&](const std::string& name, const std::vector<Matrix4>& poses) {
    Value node = Value::Map{{"name", name}, {"mesh", children.size()}};
    if (!poses.empty()) {
      const Vector3 place = poses.front().topRightCorner<3, 1>();
      node.set("translation", Value::List{place.x(), place.y(), place.z()});
      const std::vector<float> rotation = rotations({poses.front()});
      node.set("rotation", Value::List(rotation.begin(), rotation.end()));
    }
    children.emplace_back(children.size() + 1);
    nodes.push_back(std::move(node));
  };
  for (const OpenGel& gel : scene.gels) add(named("gel", gel.name), gel.world_from_gel);
  for (const OpenObject& object : scene.objects) add(named("object", object.name), object.world_from_object);
  for (const OpenSoft& soft : scene.soft) add(named("soft", soft.name), {});
  const double half = std::sqrt(0.5);  // a quarter turn about x: z up becomes y up
  const bool fixed = scene.gels.size() == 1 && scene.gels.front().world_from_gel.empty();
  nodes.insert(nodes.begin(), Value::Map{{"name", fixed ? "frame S" : "world"},
                                         {"rotation", Value::List{-half, 0.0, 0.0, half}},
                                         {"children", children}});
  return nodes;
}

void append_number(std::string& bytes, std::uint32_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

std::string glb(std::string json, const std::string& binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t size = 12 + 8 + json.size() + 8 + binary.size();
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw DataError("the scene is too large for a glTF file: {} bytes, at most 4 GiB", size);
  std::string bytes = "glTF";
  for (const std::size_t number : {std::size_t{2}, size, json.size()})
    append_number(bytes, static_cast<std::uint32_t>(number));
  bytes += "JSON" + json;
  append_number(bytes, static_cast<std::uint32_t>(binary.size()));
  return bytes + std::string("BIN\0", 4) + binary;
}

}  // namespace

std::string glb_bytes(const OpenScene& scene) {
  const std::size_t frames = scene.times_s.size();
  const double deepest = deepest_indentation(scene);
  Buffer buffer;
  Value::List meshes;
  for (const OpenGel& gel : scene.gels) meshes.push_back(gel_mesh(gel, frames, deepest, buffer));
  for (const OpenObject& object : scene.objects) meshes.push_back(object_mesh(object, buffer));
  for (const OpenSoft& soft : scene.soft) meshes.push_back(soft_mesh(soft, buffer));
  Value::List materials{material("gel", {1.0, 1.0, 1.0, 1.0}, 0.6), material("object", {0.6, 0.54, 0.44, 1.0}, 0.4)};
  if (!scene.soft.empty()) materials.push_back(material("soft", {0.35, 0.55, 0.5, 1.0}, 0.8));
  Value file = Value::Map{{"asset", Value::Map{{"version", "2.0"}, {"generator", "TacIPC export"}}},
                          {"scene", 0},
                          {"scenes", Value::List{Value::Map{{"nodes", Value::List{0}}}}},
                          {"nodes", nodes(scene)},
                          {"meshes", meshes},
                          {"materials", materials}};
  if (frames > 1) file.set("animations", Value::List{animation(scene, buffer)});
  file.set("accessors", buffer.accessors());
  file.set("bufferViews", buffer.views());
  file.set("buffers", Value::List{Value::Map{{"byteLength", buffer.bytes().size()}}});
  return glb(to_json(file), buffer.bytes());
}

}  // namespace tacipc
