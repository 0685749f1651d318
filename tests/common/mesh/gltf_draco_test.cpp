#include "common/mesh/gltf_draco.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>

#include "common/base/error.h"
#include "common/mesh/scene_file.h"
#include "tests/common/sample_files.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace gltf_draco_test {

/// The tetrahedron of kTetPoints, compressed; at a speed of 10 its triangles are listed, else they are walked over.
std::string compressed_tetrahedron(int speed) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(4);
  const int positions = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (int f = 0; f < 4; ++f) {
    float corners[3][3];
    for (int c = 0; c < 3; ++c)
      for (int axis = 0; axis < 3; ++axis) corners[c][axis] = static_cast<float>(kTetPoints[kTetFaces[f][c]][axis]);
    builder.SetAttributeValuesForFace(positions, draco::FaceIndex(static_cast<unsigned>(f)), corners[0], corners[1],
                                      corners[2]);
  }
  draco::Encoder encoder;
  encoder.SetSpeedOptions(speed, speed);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*builder.Finalize(), &buffer).ok());
  return {buffer.data(), buffer.size()};
}

/// A file whose accessors have no data: all is in the compressed bytes.
std::string glb(const std::string& bytes, int attribute = 0) {
  std::string json = fmt::format(
      R"({{"asset":{{"version":"2.0"}},"extensionsRequired":["KHR_draco_mesh_compression"],"scenes":[{{"nodes":[0]}}],)"
      R"("nodes":[{{"mesh":0,"scale":[2,2,2]}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"mode":5,)"
      R"("extensions":{{"KHR_draco_mesh_compression":{{"bufferView":0,"attributes":{{"POSITION":{}}}}}}}}}]}}],)"
      R"("buffers":[{{"byteLength":{}}}],"bufferViews":[{{"buffer":0,"byteLength":{}}}],)"
      R"("accessors":[{{"componentType":5126,"count":4,"type":"VEC3"}},{{"componentType":5123,"count":12,"type":"SCALAR"}}]}})",
      attribute, bytes.size(), bytes.size());
  Bytes file;
  file.raw("glTF").add(std::uint32_t{2}).add(static_cast<std::uint32_t>(28 + json.size() + bytes.size()));
  file.add(static_cast<std::uint32_t>(json.size())).raw("JSON").raw(json);
  file.add(static_cast<std::uint32_t>(bytes.size())).raw(std::string("BIN\0", 4)).raw(bytes);
  return file.text;
}

TEST(GltfDraco, CompressedMeshesAreRead) {
  const ScratchFolder scratch;
  for (const int speed : {0, 5, 10}) {
    const TriangleMesh mesh = read_scene_file(scratch.file("a.glb", glb(compressed_tetrahedron(speed)))).mesh;
    EXPECT_EQ(mesh.num_vertices(), 4) << speed;
    EXPECT_EQ(mesh.num_triangles(), 4) << speed;
    EXPECT_NEAR(signed_volume(mesh), 8.0 / 6.0, 1e-3) << speed;
    EXPECT_NEAR(mesh.positions.maxCoeff(), 2.0, 1e-3) << speed;
  }
}

TEST(GltfDraco, DamagedOnesAreRefused) {
  const ScratchFolder scratch;
  const std::string whole = compressed_tetrahedron(5);
  const auto error = [&](const std::string& bytes) {
    const std::filesystem::path file = scratch.file("a.glb", bytes);
    return message_of<DataError>([&] { read_scene_file(file); }).substr(file.string().size());
  };
  EXPECT_THAT(error(glb(whole.substr(0, whole.size() / 2))),
              ::testing::StartsWith(": its Draco compression is damaged ("));
  EXPECT_THAT(error(glb("no Draco at all!")), ::testing::StartsWith(": its Draco compression is damaged ("));
  EXPECT_EQ(error(glb(whole, 3)), ": its Draco compression has no attribute 3 of 3 components");
}

}  // namespace gltf_draco_test
}  // namespace tacipc
