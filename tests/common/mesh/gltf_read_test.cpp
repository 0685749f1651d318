// glTF as exporters write it: every way to store numbers and to place meshes, and what is refused by name.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/mesh/scene_file.h"
#include "tests/common/sample_files.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace gltf_read_test {

constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125,
              kFloat = 5126;

/// A file in the making: arrays behind each other, and the lists that describe them.
class Gltf {
 public:
  std::string views, accessors, meshes, nodes, more;

  template <typename T>
  int view(const std::vector<T>& values, int stride = 0) {
    while (bytes.text.size() % 4 != 0) bytes.add(char{0});
    add(views, fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{}{}}})", bytes.text.size(),
                           values.size() * sizeof(T), stride > 0 ? fmt::format(R"(,"byteStride":{})", stride) : ""));
    for (const T value : values) bytes.add(value);
    return num_views++;
  }
  int accessor(int view, int type, std::size_t count, const std::string& shape, const std::string& rest = "") {
    add(accessors, fmt::format(R"({{{}"componentType":{},"count":{},"type":"{}"{}}})",
                               view >= 0 ? fmt::format(R"("bufferView":{},)", view) : "", type, count, shape, rest));
    return num_accessors++;
  }
  int vectors(const std::vector<float>& values, const std::string& rest = "") {
    return accessor(view(values), kFloat, values.size() / 3, "VEC3", rest);
  }
  int indices(const std::vector<std::uint16_t>& values) {
    return accessor(view(values), kUnsignedShort, values.size(), "SCALAR");
  }
  /// A mesh of one primitive, with further keys of it.
  int mesh(int positions, int indices, const std::string& rest = "", const std::string& attributes = "",
           const std::string& of_mesh = "") {
    add(meshes, fmt::format(R"({{"primitives":[{{"attributes":{{"POSITION":{}{}}}{}{}}}]{}}})", positions, attributes,
                            indices >= 0 ? fmt::format(R"(,"indices":{})", indices) : "", rest, of_mesh));
    return num_meshes++;
  }
  void node(const std::string& content) { add(nodes, "{" + content + "}"); }

  std::string json(const std::string& uri = "") const {
    return fmt::format(
        R"({{"asset":{{"version":"2.0"}}{},"buffers":[{{"byteLength":{}{}}}],"bufferViews":[{}],"accessors":[{}],"meshes":[{}],"nodes":[{}]}})",
        more.empty() ? R"(,"scene":0,"scenes":[{"nodes":[0]}])" : more, bytes.text.size(),
        uri.empty() ? "" : ",\"uri\":\"" + uri + "\"", views, accessors, meshes, nodes);
  }
  std::string glb() const { return glb_of(json()); }
  std::string glb_of(std::string text, std::size_t padding = 4) const {
    while (text.size() % padding != 0) text += ' ';
    Bytes file;
    file.raw("glTF").add(std::uint32_t{2}).add(static_cast<std::uint32_t>(28 + text.size() + bytes.text.size()));
    file.add(static_cast<std::uint32_t>(text.size())).raw("JSON").raw(text);
    file.add(static_cast<std::uint32_t>(bytes.text.size())).raw(std::string("BIN\0", 4)).raw(bytes.text);
    return file.text;
  }
  Bytes bytes;

 private:
  static void add(std::string& list, const std::string& item) { list += (list.empty() ? "" : ",") + item; }
  int num_views = 0, num_accessors = 0, num_meshes = 0;
};

const std::vector<std::uint16_t> kCorners{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
constexpr float kPoints[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 4}};

std::vector<float> points() { return {&kPoints[0][0], &kPoints[0][0] + 12}; }

/// The tetrahedron at 0, x = 1, y = 2, z = 4, at the first node.
Gltf tetrahedron(const std::string& node = R"("mesh":0)") {
  Gltf file;
  const int positions = file.vectors(points());
  file.mesh(positions, file.indices(kCorners));
  file.node(node);
  return file;
}

class GltfRead : public ::testing::Test {
 protected:
  TriangleMesh read(const std::string& bytes, const std::string& name = "a.glb") {
    const SceneMesh scene = read_scene_file(scratch_.file(name, bytes));
    EXPECT_EQ(scene.unit, "m");
    return scene.mesh;
  }
  std::string error(const std::string& bytes, const std::string& name = "a.glb") {
    std::string text = message_of<DataError>([&] { read(bytes, name); });
    const std::string folder = (scratch_ / "").string();
    return text.starts_with(folder) ? text.substr(folder.size()) : "not refused, or without its name: " + text;
  }
  /// Least and most corner.
  std::vector<double> extent(const std::string& bytes) {
    const Positions p = read(bytes).positions;
    return {p.col(0).minCoeff(), p.col(1).minCoeff(), p.col(2).minCoeff(),
            p.col(0).maxCoeff(), p.col(1).maxCoeff(), p.col(2).maxCoeff()};
  }
  static void expect_near(const std::vector<double>& values, const std::vector<double>& expected) {
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], expected[i], 1e-6) << i;
  }

  ScratchFolder scratch_;
};

TEST_F(GltfRead, NumbersAreReadHoweverTheyAreStored) {
  const TriangleMesh plain = read(tetrahedron().glb());
  EXPECT_EQ(plain.num_vertices(), 4);
  EXPECT_NEAR(signed_volume(plain), 8.0 / 6.0, 1e-12);

  std::vector<Gltf> same(6);
  std::vector<float> interleaved;  // behind a normal, before a texture coordinate
  for (const auto& p : kPoints) interleaved.insert(interleaved.end(), {0, 0, 1, p[0], p[1], p[2], 0.5, 0.5});
  int view = same[0].view(interleaved, 32);
  same[0].mesh(same[0].accessor(view, kFloat, 4, "VEC3", R"(,"byteOffset":12)"), same[0].indices(kCorners));
  // Indices of one byte and of four.
  int positions = same[1].vectors(points());
  view = same[1].view(std::vector<std::uint8_t>(kCorners.begin(), kCorners.end()));
  same[1].mesh(positions, same[1].accessor(view, kUnsignedByte, 12, "SCALAR"));
  positions = same[2].vectors(points());
  view = same[2].view(std::vector<std::uint32_t>(kCorners.begin(), kCorners.end()));
  same[2].mesh(positions, same[2].accessor(view, kUnsignedInt, 12, "SCALAR"));
  // Sparse: with a base of other numbers, and without any base.
  const auto sparse = [](Gltf& file, int base, const std::vector<std::uint8_t>& which,
                         const std::vector<float>& values) {
    const int places = file.view(which), at = file.view(values);
    return file.accessor(
        base, kFloat, 4, "VEC3",
        fmt::format(
            R"(,"sparse":{{"count":{},"indices":{{"bufferView":{},"componentType":5121}},"values":{{"bufferView":{}}}}})",
            which.size(), places, at));
  };
  positions =
      sparse(same[3], same[3].view(std::vector<float>{0, 0, 0, 9, 9, 9, 0, 2, 0, 8, 8, 8}), {1, 3}, {1, 0, 0, 0, 0, 4});
  same[3].mesh(positions, same[3].indices(kCorners));
  positions = sparse(same[4], -1, {1, 2, 3}, {1, 0, 0, 0, 2, 0, 0, 0, 4});
  same[4].mesh(positions, same[4].indices(kCorners));
  // Quantized, as fractions of the largest number; the node makes them large again.
  std::vector<std::int16_t> codes;
  for (const auto& p : kPoints)
    codes.insert(codes.end(),
                 {std::int16_t(p[0] * 32767 / 4), std::int16_t(p[1] * 32767 / 4), std::int16_t(p[2] * 32767 / 4), 0});
  positions = same[5].accessor(same[5].view(codes, 8), kShort, 4, "VEC3", R"(,"normalized":true)");
  same[5].mesh(positions, same[5].indices(kCorners));
  for (std::size_t i = 0; i < same.size(); ++i) {
    same[i].node(i == 5 ? R"("mesh":0,"scale":[4,4,4])" : R"("mesh":0)");
    if (i == 5) same[i].more = R"(,"scene":0,"scenes":[{"nodes":[0]}],"extensionsRequired":["KHR_mesh_quantization"])";
    const TriangleMesh mesh = read(same[i].glb());
    EXPECT_EQ(mesh.triangles, plain.triangles) << i;
    EXPECT_TRUE(mesh.positions.isApprox(plain.positions, i == 5 ? 1e-4 : 1e-12)) << i;
  }
}

TEST_F(GltfRead, EveryKindOfTriangleListIsRead) {
  Gltf unindexed, strip, fan;
  std::vector<float> corners;
  for (const int c : kCorners) corners.insert(corners.end(), {kPoints[c][0], kPoints[c][1], kPoints[c][2]});
  unindexed.mesh(unindexed.vectors(corners), -1);
  const TriangleMesh soup = read((unindexed.node(R"("mesh":0)"), unindexed.glb()));
  EXPECT_EQ(soup.num_vertices(), 12);
  EXPECT_NEAR(signed_volume(soup), 8.0 / 6.0, 1e-12);
  // The tetrahedron as one strip, each second triangle turned round.
  int positions = strip.vectors(points());
  strip.mesh(positions, strip.indices({0, 2, 1, 3, 0, 2}), R"(,"mode":5)");
  strip.node(R"("mesh":0)");
  EXPECT_EQ(read(strip.glb()).num_triangles(), 4);
  EXPECT_NEAR(signed_volume(read(strip.glb())), 8.0 / 6.0, 1e-12);
  // Three sides round corner 0, and the fourth.
  positions = fan.vectors(points());
  fan.mesh(positions, fan.indices({0, 1, 3, 2, 1}), R"(,"mode":6)");
  fan.mesh(positions, fan.indices({1, 2, 3}));
  fan.node(R"("mesh":0,"children":[1])");
  fan.node(R"("mesh":1)");
  EXPECT_NEAR(signed_volume(read(fan.glb())), 8.0 / 6.0, 1e-12);
  // Lines and points are no surface.
  Gltf lines;
  positions = lines.vectors(points());
  lines.mesh(positions, lines.indices({0, 1, 2, 3}), R"(,"mode":1)");
  lines.node(R"("mesh":0)");
  EXPECT_EQ(error(lines.glb()), "a.glb: has no triangles");
}

TEST_F(GltfRead, NodesPlaceMeshesFromTheInsideOut) {
  Gltf nested = tetrahedron(R"("children":[1],"scale":[2,2,2])");
  const double half = std::sqrt(0.5);
  nested.node(fmt::format(R"("children":[2],"rotation":[0,0,{0},{0}])", half));  // a quarter turn about z
  nested.node(R"("mesh":0,"translation":[10,0,0],"scale":[1,0.5,1])");
  expect_near(extent(nested.glb()), {-2, 20, 0, 0, 22, 8});
  Gltf by_matrix = tetrahedron(R"("mesh":0,"matrix":[0,2,0,0, -2,0,0,0, 0,0,2,0, 5,6,7,1])");
  expect_near(extent(by_matrix.glb()), {1, 6, 7, 5, 8, 15});
  // One mesh at three places, mirrored at one of them.
  Gltf instances = tetrahedron(R"("children":[1,2,3])");
  for (const char* at : {R"("mesh":0)", R"("mesh":0,"translation":[10,0,0])", R"("mesh":0,"scale":[-1,1,1])"})
    instances.node(at);
  EXPECT_NEAR(signed_volume(read(instances.glb())), 3 * 8.0 / 6.0, 1e-9);
  expect_near(extent(instances.glb()), {-1, 0, 0, 11, 2, 4});
}

TEST_F(GltfRead, OneSceneIsRead) {
  Gltf file = tetrahedron();
  file.node(R"("mesh":0,"translation":[5,0,0])");
  file.more = R"(,"scene":1,"scenes":[{"nodes":[0]},{"nodes":[1]}])";
  expect_near(extent(file.glb()), {5, 0, 0, 6, 2, 4});
  file.more = R"(,"scenes":[{"nodes":[1]},{"nodes":[0]}])";
  expect_near(extent(file.glb()), {5, 0, 0, 6, 2, 4});
  file.more = R"(,"extras":[])";  // no scenes: all that is nobody's child
  expect_near(extent(file.glb()), {0, 0, 0, 6, 2, 4});
  file.more = R"(,"scene":2,"scenes":[{"nodes":[1]},{"nodes":[0]}])";
  EXPECT_EQ(error(file.glb()), "a.glb: scene is 2, but there are 2");
}

TEST_F(GltfRead, MorphTargetsHaveTheirWeights) {
  const auto file = [](const std::string& of_mesh, const std::string& of_node) {
    Gltf made;
    const int positions = made.vectors(points()), up = made.vectors({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4}),
              aside = made.vectors({2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0});
    made.mesh(positions, made.indices(kCorners),
              fmt::format(R"(,"targets":[{{"POSITION":{}}},{{"POSITION":{}}}])", up, aside), "", of_mesh);
    made.node(R"("mesh":0)" + of_node);
    return made.glb();
  };
  expect_near(extent(file("", "")), {0, 0, 0, 1, 2, 4});
  expect_near(extent(file(R"(,"weights":[0.5,0])", "")), {0, 0, 0, 1, 2, 6});
  expect_near(extent(file(R"(,"weights":[0.5,0])", R"(,"weights":[0,1])")), {2, 0, 0, 3, 2, 4});
}

TEST_F(GltfRead, SkinsPutTheirMeshWhereTheirJointsAre) {
  const auto file = [](const std::vector<std::uint8_t>& joints, const std::vector<float>& weights, bool bound,
                       const std::string& skin) {
    Gltf made;
    const int positions = made.vectors(points()), of = made.accessor(made.view(joints), kUnsignedByte, 4, "VEC4"),
              by = made.accessor(made.view(weights), kFloat, 4, "VEC4");
    std::vector<float> inverse;  // both joints were bound at z = 1
    for (int j = 0; j < 2; ++j) inverse.insert(inverse.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 1});
    const int matrices = made.accessor(made.view(inverse), kFloat, 2, "MAT4");
    made.mesh(positions, made.indices(kCorners), "", fmt::format(R"(,"JOINTS_0":{},"WEIGHTS_0":{})", of, by));
    made.node(R"("children":[1,2])");
    made.node(R"("mesh":0,"skin":0,"translation":[500,500,500])");  // has no effect on a mesh with a skin
    made.node(R"("translation":[0,0,1],"children":[3])");
    made.node(R"("translation":[3,0,0])");
    made.more = fmt::format(R"(,"scene":0,"scenes":[{{"nodes":[0]}}],"skins":[{{"joints":{}{}}}])", skin,
                            bound ? fmt::format(R"(,"inverseBindMatrices":{})", matrices) : "");
    return made.glb();
  };
  const std::vector<std::uint8_t> first(16, 0), last{0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0};
  const std::vector<float> whole{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0},
      half{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0};
  expect_near(extent(file(first, whole, true, "[2,3]")), {0, 0, 0, 1, 2, 4});
  expect_near(extent(file(first, whole, false, "[2,3]")), {0, 0, 1, 1, 2, 5});
  expect_near(extent(file(last, half, true, "[2,3]")), {0, 0, 0, 4, 2, 4});
  EXPECT_EQ(error(file(last, half, true, "[2]")), "a.glb: vertex 1 follows the joint 1 of 1 (counted from 0)");
  EXPECT_EQ(error(file(last, half, true, "[2,4]")), "a.glb: skins[0].joints is 4, but there are 4");
}

TEST_F(GltfRead, TextFilesHoldTheirBuffers) {
  const Gltf file = tetrahedron();
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string base64 = "data:application/octet-stream;base64,";
  const std::string& bytes = file.bytes.text;  // a multiple of three
  for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[i + k])); };
    const unsigned bits = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (const int shift : {18, 12, 6, 0}) base64 += kDigits[(bits >> shift) & 63];
  }
  ASSERT_EQ(bytes.size() % 3, 0u);
  const TriangleMesh plain = read(file.glb());
  const std::string text = file.json(base64);
  std::string utf16 = "\xFF\xFE", swapped;
  for (const char c : text) (utf16 += c) += '\0', (swapped += '\0') += c;
  for (const std::string& same : {text, "\xEF\xBB\xBF" + text, "\n\t" + text + "\n"})
    EXPECT_EQ(read(same, "a.gltf").positions, plain.positions);
  EXPECT_EQ(error(utf16, "a.gltf"), "a.gltf: is UTF-16 (little-endian) text; save it as UTF-8");
  EXPECT_EQ(error(swapped, "a.gltf"), "a.gltf: is UTF-16 (big-endian) text; save it as UTF-8");
  EXPECT_EQ(error(file.json("tet.bin"), "a.gltf"),
            "a.gltf: buffers[0] is in another file, tet.bin; buffers must be inside the file (as .glb, for example)");
  EXPECT_EQ(error(file.json(base64.substr(0, base64.size() - 8)), "a.gltf"), "a.gltf: buffers[0] has 66 bytes of 72");
  EXPECT_EQ(error(file.json(base64 + "?"), "a.gltf"), "a.gltf: buffers[0] has '?' in its base64");
  EXPECT_EQ(error("{\"asset\":\n{\"version\":2.0", "a.gltf"), "a.gltf: is not glTF: no JSON from line 2, column 15 on");
  EXPECT_EQ(error("{}", "a.gltf"), "a.gltf: is not glTF: it has no 'asset'");
}

TEST_F(GltfRead, AJsonChunkThatIsNotPaddedIsRead) {
  Gltf file = tetrahedron();
  const TriangleMesh plain = read(file.glb());
  for (const char* name : {"", "a", "ab", "abc"}) {  // lengths of every rest
    file.more = fmt::format(R"(,"scene":0,"scenes":[{{"nodes":[0]}}],"extras":"{}")", name);
    EXPECT_EQ(read(file.glb_of(file.json(), 1)).positions, plain.positions)
        << "the next chunk follows at once " << name;
    // It follows where it would after padding that the length does not count.
    const std::string text = file.json(), spaces((4 - text.size() % 4) % 4, ' ');
    std::string bytes = file.glb_of(text, 1);
    bytes.insert(20 + text.size(), spaces);
    EXPECT_EQ(read(bytes).positions, plain.positions) << "padded beyond its length " << name;
    std::string zeros = file.glb_of(text + std::string(spaces.size(), '\0'), 1);
    EXPECT_EQ(read(zeros).positions, plain.positions) << "padded with zeros " << name;
  }
  std::string broken = file.glb_of(file.json() + " ", 1);
  broken.replace(broken.find(std::string("BIN\0", 4)), 3, "???");
  EXPECT_THAT(error(broken),
              ::testing::MatchesRegex("a.glb: no binary chunk follows its JSON chunk of [0-9]+ bytes.*"));
}

TEST_F(GltfRead, BrokenFilesAreRefused) {
  const std::string whole = tetrahedron().glb();
  EXPECT_THAT(error(whole.substr(0, 100)), ::testing::StartsWith("a.glb: is cut off: 100 of "));
  EXPECT_EQ(error("glTF"), "a.glb: the file ends inside the header of a binary glTF at byte 4");
  EXPECT_EQ(error("glTF, but no more"), "a.glb: is binary glTF of version 1969365036; version 2 is read");
  EXPECT_EQ(error(""), "a.glb: the file is empty");
  const auto changed = [&](const std::string& from, const std::string& to) {
    const Gltf file = tetrahedron();
    std::string text = file.json();
    const std::size_t at = text.find(from);
    return at == std::string::npos ? "no such text" : error(file.glb_of(text.replace(at, from.size(), to)));
  };
  EXPECT_EQ(changed("\"2.0\"", "\"1.0\""), "a.glb: is glTF of version 1.0; version 2.0 is read");
  EXPECT_EQ(changed("\"count\":4", "\"count\":5"), "a.glb: accessors[0] reaches beyond the 48 bytes of bufferViews[0]");
  EXPECT_EQ(changed("\"count\":4", "\"count\":-4"), "a.glb: accessors[0].count is no whole number from 0");
  EXPECT_EQ(changed("\"count\":4", "\"count\":4.5"), "a.glb: accessors[0].count is no whole number from 0");
  EXPECT_EQ(changed("\"count\":4,", ""), "a.glb: accessors[0].count is missing");
  EXPECT_EQ(changed("\"count\":4", "\"count\":2"), "a.glb: accessors[1] names the vertex 2 of 2 (counted from 0)");
  EXPECT_EQ(changed("\"count\":12", "\"count\":11"), "a.glb: has 11 corners of triangles, no multiple of 3");
  EXPECT_EQ(changed("5126", "5130"), "a.glb: accessors[0] has the component type 5130, which there is not");
  EXPECT_EQ(changed("VEC3", "VEC2"), "a.glb: accessors[0] is VEC2, not VEC3");
  EXPECT_EQ(changed("\"bufferView\":0,", ""), "a.glb: accessors[0] has no positions in it");
  EXPECT_EQ(changed("\"byteLength\":48", "\"byteLength\":480"),
            "a.glb: bufferViews[0] reaches beyond the 72 bytes of its buffer");
  EXPECT_EQ(changed("\"POSITION\":0", "\"POSITION\":9"),
            "a.glb: meshes[0].primitives[0].attributes.POSITION is 9, but there are 2");
  EXPECT_EQ(changed("\"mesh\":0}", "\"mesh\":0,\"children\":[0]}"),
            "a.glb: nodes[0] is in the scene twice, or below itself");
  EXPECT_EQ(changed("\"mesh\":0}", "\"mesh\":0,\"rotation\":[0,0,0,0]}"), "a.glb: nodes[0].rotation is no rotation");
  EXPECT_EQ(changed("\"mesh\":0}", "\"mesh\":0,\"matrix\":[1]}"), "a.glb: nodes[0].matrix has 1 numbers, needs 16");
}

TEST_F(GltfRead, ExtensionsThatChangeShapesAreRefused) {
  const auto requires_extension = [&](const std::string& extension) {
    Gltf file = tetrahedron();
    file.more = R"(,"scenes":[{"nodes":[0]}],"extensionsRequired":[")" + extension + "\"]";
    return error(file.glb());
  };
  EXPECT_EQ(requires_extension("EXT_meshopt_compression"),
            "a.glb: is compressed (EXT_meshopt_compression); export it without compression");
  EXPECT_EQ(requires_extension("VENDOR_shapes"), "a.glb: requires the extension VENDOR_shapes, which is not read");
  EXPECT_EQ(error(tetrahedron(R"("mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{}})").glb()),
            "a.glb: nodes[0] has instances by EXT_mesh_gpu_instancing, which is not read");
  Gltf shiny = tetrahedron();
  shiny.more = R"(,"scenes":[{"nodes":[0]}],"extensionsRequired":["KHR_materials_unlit","KHR_texture_transform"])";
  EXPECT_EQ(read(shiny.glb()).num_triangles(), 4);
}

}  // namespace gltf_read_test
}  // namespace tacipc
