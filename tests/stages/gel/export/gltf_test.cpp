#include "stages/gel/export/gltf.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <map>

#include "common/base/files.h"
#include "common/stage/record.h"
#include "stages/gel/export/open_press.h"
#include "tests/stages/gel/export/pressed_cube.h"

namespace tacipc {
namespace gltf_test {

using ::testing::ElementsAre;
using ::testing::Pointwise;

/// A .glb file taken apart. JSON is YAML too, so the reader of our configurations reads it.
class GlbFile {
 public:
  explicit GlbFile(const ScratchFolder& scratch, const std::string& bytes) : bytes_(bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(number(4), 2u);
    EXPECT_EQ(number(8), bytes.size());
    json_size_ = number(12);
    EXPECT_EQ(json_size_ % 4, 0u);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(number(20 + json_size_), bytes.size() - 28 - json_size_);
    EXPECT_EQ(bytes.substr(24 + json_size_, 4), std::string("BIN\0", 4));
    path_ = scratch.file("scene.json", bytes.substr(20, json_size_));
  }
  Record json() const { return Record::from_file(path_); }
  Record accessor(int index) const { return json().sections("accessors").at(static_cast<std::size_t>(index)); }
  /// All numbers of an accessor.
  template <typename T>
  std::vector<double> values(int index, std::size_t components) const {
    const Record in = accessor(index);
    const Record view = json().sections("bufferViews").at(static_cast<std::size_t>(in.required_count("bufferView")));
    const auto count = static_cast<std::size_t>(in.required_count("count")) * components;
    EXPECT_EQ(static_cast<std::size_t>(view.required_count("byteLength")), count * sizeof(T));
    const auto offset = static_cast<std::size_t>(view.required_count("byteOffset"));
    EXPECT_EQ(offset % 4, 0u);
    EXPECT_LE(offset + count * sizeof(T), number(20 + json_size_));
    std::vector<T> values(count);
    std::memcpy(values.data(), bytes_.data() + 28 + json_size_ + offset, count * sizeof(T));
    return {values.begin(), values.end()};
  }

 private:
  std::size_t number(std::size_t at) const {
    std::uint32_t n = 0;
    std::memcpy(&n, bytes_.data() + at, sizeof n);
    return n;
  }
  std::string bytes_;
  std::size_t json_size_ = 0;
  std::filesystem::path path_;
};

class GltfTest : public ::testing::Test {
 protected:
  GltfTest() {
    write_pressed_cube(scratch_);
    bytes_ = bytes("press");
    again_ = bytes("press");
  }
  std::string bytes(const char* folder) const {
    return glb_bytes(open_scene(scratch_ / folder, scratch_ / "gel.msh", scratch_ / "object.ply"));
  }

  ScratchFolder scratch_;
  std::string bytes_, again_;
};

TEST_F(GltfTest, TheFrontMovesAsInThePress) {
  const GlbFile file(scratch_, bytes_);
  const Record gel = file.json().sections("meshes").at(0).sections("primitives").at(0);
  const int rest = gel.section("attributes").required_count("POSITION");
  const int moved = gel.sections("targets").at(0).required_count("POSITION");
  EXPECT_THAT(
      file.values<float>(rest, 3),
      Pointwise(::testing::DoubleNear(1e-9), std::vector<double>{0, 0, 0, 0.01, 0, 0, 0, 0.01, 0, 0.01, 0.01, 0}));
  EXPECT_THAT(file.values<float>(moved, 3),
              Pointwise(::testing::DoubleNear(1e-9),
                        std::vector<double>{0, 0, -0.002, 0, 0, -0.002, 0, 0, -0.002, 0, 0, -0.002}));
  EXPECT_NEAR(file.accessor(moved).numbers("min", 3)->at(2), -0.002, 1e-9);
  EXPECT_NEAR(file.accessor(rest).numbers("max", 3)->at(0), 0.01, 1e-9);
  EXPECT_EQ(file.accessor(rest).numbers("min", 3)->at(0), 0.0);
  for (const double corner : file.values<std::uint32_t>(gel.required_count("indices"), 1)) EXPECT_LT(corner, 4);
  const std::vector<double> colors = file.values<std::uint16_t>(gel.section("attributes").required_count("COLOR_0"), 4);
  EXPECT_GT(colors[0], 50'000);  // all are as deep as the deepest
  EXPECT_EQ(colors[3], 65535);
}

TEST_F(GltfTest, TheObjectGoesThroughItsPosesAndZPointsUp) {
  const GlbFile file(scratch_, bytes_);
  const std::vector<Record> nodes = file.json().sections("nodes");
  const auto turn = *nodes.at(0).numbers("rotation", 4);  // of z by −90° about x: y
  EXPECT_NEAR(2.0 * (turn[1] * turn[2] - turn[3] * turn[0]), 1.0, 1e-12);
  const Record animation = file.json().sections("animations").at(0);
  std::map<std::string, int> outputs;
  for (const Record& channel : animation.sections("channels")) {
    const auto sampler = static_cast<std::size_t>(channel.required_count("sampler"));
    const Record target = channel.section("target");
    EXPECT_EQ(target.required_count("node"), target.required_text("path") == "weights" ? 1 : 2);
    outputs[target.required_text("path")] = animation.sections("samplers").at(sampler).required_count("output");
  }
  EXPECT_THAT(file.values<float>(outputs.at("weights"), 1), ElementsAre(0, 1));
  EXPECT_THAT(file.values<float>(outputs.at("translation"), 3), ElementsAre(0, 0, 0, 1, 2, 3));
  const double half = std::sqrt(0.5);
  EXPECT_THAT(file.values<float>(outputs.at("rotation"), 4),
              Pointwise(::testing::DoubleNear(1e-7), std::vector<double>{0, 0, 0, 1, 0, 0, half, half}));
  const Record time = file.accessor(animation.sections("samplers").at(0).required_count("input"));
  EXPECT_NEAR(time.numbers("max", 1)->at(0), 0.01, 1e-9);
}

TEST_F(GltfTest, TheSamePressGivesTheSameBytes) { EXPECT_EQ(bytes_, again_); }

/// Rows of three or four numbers of an accessor.
Eigen::MatrixXd rows_of(const GlbFile& file, int accessor, std::size_t components) {
  const std::vector<double> values = file.values<float>(accessor, components);
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      values.data(), static_cast<Eigen::Index>(values.size() / components), static_cast<Eigen::Index>(components));
}

/// Places of a node's vertices in the world in a frame, as a viewer computes them from the animation.
Eigen::MatrixXd played(const GlbFile& file, std::size_t node, Eigen::Index frame) {
  const Record json = file.json(), shown = json.sections("nodes").at(node);
  const Record mesh = json.sections("meshes").at(static_cast<std::size_t>(shown.required_count("mesh")));
  const Record primitive = mesh.sections("primitives").at(0), animation = json.sections("animations").at(0);
  Eigen::MatrixXd points = rows_of(file, primitive.section("attributes").required_count("POSITION"), 3);
  std::map<std::string, int> outputs;
  for (const Record& channel : animation.sections("channels")) {
    const Record target = channel.section("target"),
                 sampler =
                     animation.sections("samplers").at(static_cast<std::size_t>(channel.required_count("sampler")));
    if (target.required_count("node") == static_cast<int>(node))
      outputs[target.required_text("path")] = sampler.required_count("output");
  }
  if (primitive.has("targets")) {
    const std::vector<Record> targets = primitive.sections("targets");
    const Eigen::MatrixXd weights = rows_of(file, outputs.at("weights"), targets.size());
    for (std::size_t t = 0; t < targets.size(); ++t)
      points += weights(frame, static_cast<Eigen::Index>(t)) * rows_of(file, targets[t].required_count("POSITION"), 3);
  }
  const Eigen::VectorXd q = rows_of(file, outputs.at("rotation"), 4).row(frame);
  const Matrix3 turn = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
  const Eigen::RowVector3d place = rows_of(file, outputs.at("translation"), 3).row(frame);
  return (points * turn.transpose()).rowwise() + place;
}

TEST_F(GltfTest, InASceneEveryGelAndObjectIsWhereItsPosePutsIt) {
  write_pressed_scene(scratch_);
  const GlbFile file(scratch_, bytes("scene"));
  const std::vector<Record> nodes = file.json().sections("nodes");
  ASSERT_EQ(nodes.size(), 4u);
  EXPECT_EQ(nodes[0].required_text("name"), "world");
  EXPECT_EQ(nodes[1].required_text("name"), "gel left");
  EXPECT_EQ(nodes[2].required_text("name"), "gel right");
  EXPECT_EQ(nodes[3].required_text("name"), "object");
  const std::vector<Matrix4> fingers = pressed_scene_fingers();
  for (const int frame : {0, 1}) {
    for (const std::size_t g : {0u, 1u}) {
      const PressFolder press(scratch_ / (g == 0 ? "scene/left/press" : "scene/right/press"));
      const Matrix4& pose = fingers[2 * static_cast<std::size_t>(frame) + g];
      const Positions x = press.positions(static_cast<std::size_t>(frame))(press.front_vertices(), Eigen::all);
      const Eigen::MatrixXd there =
          (x * pose.topLeftCorner<3, 3>().transpose()).rowwise() + pose.topRightCorner<3, 1>().transpose();
      EXPECT_LT((played(file, 1 + g, frame) - there).cwiseAbs().maxCoeff(), 1e-8) << "gel " << g << ", frame " << frame;
      EXPECT_GT(there.cwiseAbs().maxCoeff(), 1e-2);
    }
    Eigen::MatrixXd object = read_triangle_mesh(scratch_ / "object.ply", 1.0).positions;
    object.col(2).array() -= 0.003 * frame;
    EXPECT_LT((played(file, 3, frame) - object).cwiseAbs().maxCoeff(), 1e-7) << "frame " << frame;
  }
}

}  // namespace gltf_test
}  // namespace tacipc
