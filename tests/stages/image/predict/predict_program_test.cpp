#include <fmt/core.h>
#include <gmock/gmock.h>
#include <onnx/onnx_pb.h>

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <vector>

#include "common/base/files.h"
#include "common/image/image.h"
#include "common/sample/depth_model.h"
#include "common/stage/record.h"
#include "tests/program_test.h"

namespace tacipc {
namespace predict_program_test {

constexpr int kWidth = 8, kHeight = 6;

// Networks of depthnet are read in tests/stages/image/depthnet; here is the smallest there can be, by hand:
// 0.01 red − 0.02 green + 0.03 blue of the change, + 0.5 mm.
onnx::ModelProto small_network() {
  onnx::ModelProto model;
  model.set_ir_version(6);
  model.set_producer_name(DepthModel::kProducer);
  model.add_opset_import()->set_version(11);
  onnx::GraphProto& graph = *model.mutable_graph();
  const auto declare = [](onnx::ValueInfoProto& value, const char* name, std::initializer_list<int> shape) {
    value.set_name(name);
    value.mutable_type()->mutable_tensor_type()->set_elem_type(onnx::TensorProto::FLOAT);
    for (const int size : shape)
      value.mutable_type()->mutable_tensor_type()->mutable_shape()->add_dim()->set_dim_value(size);
  };
  declare(*graph.add_input(), DepthModel::kImage, {1, kHeight, kWidth, 3});
  declare(*graph.add_input(), DepthModel::kReference, {1, kHeight, kWidth, 3});
  declare(*graph.add_output(), DepthModel::kIndentation, {1, 1, kHeight, kWidth});
  const auto constant = [&](const char* name, std::initializer_list<int> shape, std::initializer_list<float> values) {
    onnx::TensorProto& added = *graph.add_initializer();
    added.set_name(name);
    added.set_data_type(onnx::TensorProto::FLOAT);
    for (const int size : shape) added.add_dims(size);
    for (const float value : values) added.add_float_data(value);
  };
  constant("w", {1, 3, 1, 1}, {0.01F, -0.02F, 0.03F});
  constant("b", {1}, {0.5F});
  const auto node = [&](const char* type, std::initializer_list<const char*> inputs,
                        const char* output) -> onnx::NodeProto& {
    onnx::NodeProto& added = *graph.add_node();
    added.set_op_type(type);
    added.set_name(output);
    for (const char* input : inputs) added.add_input(input);
    added.add_output(output);
    return added;
  };
  const auto numbers = [](onnx::NodeProto& of, const char* name, std::initializer_list<int> values) {
    onnx::AttributeProto& added = *of.add_attribute();
    added.set_name(name);
    added.set_type(onnx::AttributeProto::INTS);
    for (const int value : values) added.add_ints(value);
  };
  numbers(node("Transpose", {DepthModel::kImage}, "first"), "perm", {0, 3, 1, 2});
  numbers(node("Transpose", {DepthModel::kReference}, "second"), "perm", {0, 3, 1, 2});
  node("Sub", {"first", "second"}, "change");
  numbers(node("Conv", {"change", "w", "b"}, DepthModel::kIndentation), "kernel_shape", {1, 1});
  return model;
}

class Predict : public ProgramTest {
 protected:
  void SetUp() override {
    for (std::size_t i = 0; i < image_.pixels.size(); ++i) image_.pixels[i] = static_cast<std::uint8_t>(i * 37 % 256);
    write_png(scratch_ / "a.png", image_);
    write_png(scratch_ / "b.png", ByteImage(kWidth, kHeight, 3, 100));
    write_png(scratch_ / "background.png", ByteImage(kWidth, kHeight, 3, 100));
    write_model(small_network());
  }
  void write_model(const onnx::ModelProto& model) { write_file(scratch_ / "model.onnx", model.SerializeAsString()); }
  int predict(const std::string& flags) {
    return run_command(fmt::format("cd '{}' && '{}/predict' --out out --model model.onnx {}", (scratch_ / "").string(),
                                   TACIPC_BIN_DIR, flags));
  }

  ByteImage image_{kWidth, kHeight, 3};
};

TEST_F(Predict, ReadsDepthsInMetres) {
  write_exr(scratch_ / "rest.exr", FloatImage(kWidth, kHeight, 1, 0.02F), {"Y"});
  ASSERT_EQ(predict("--images a.png b.png --background background.png --rest rest.exr"), 0) << said_;
  const FloatImage indentation = read_exr(scratch_ / "out/indentation/a.exr", {"Y"}),
                   depth = read_exr(scratch_ / "out/depth/a.exr", {"Y"});
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto change = [&](int c) { return image_.at(x, y, c) - 100.0; };
      const double expected = 0.01 * change(0) - 0.02 * change(1) + 0.03 * change(2) + 0.5;
      EXPECT_NEAR(indentation.at(x, y, 0), 1e-3 * expected, 1e-8);
      EXPECT_NEAR(depth.at(x, y, 0), 0.02 - 1e-3 * expected, 1e-8);
    }
  const Record record = Record::from_file(scratch_ / "out/predict.yaml").section("summary");
  EXPECT_NEAR(record.section("deepest_mm").required_number("b"), 0.5, 1e-6);
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "out/indentation/b.png"));
  const std::string first = read_file(scratch_ / "out/indentation/a.exr");
  ASSERT_EQ(predict("--images a.png b.png --background background.png --threads 2"), 0) << said_;
  EXPECT_EQ(read_file(scratch_ / "out/indentation/a.exr"), first);
}

TEST_F(Predict, RefusesWhatIsNoNetworkOrDamaged) {
  const std::string read = "--images a.png --background background.png";
  const std::string whole = small_network().SerializeAsString();
  std::vector<std::string> files{"not a network", "", whole.substr(0, whole.size() - 7)};
  const std::vector<std::function<void(onnx::ModelProto&)>> damages{
      [](onnx::ModelProto& model) { model.set_producer_name("pytorch"); },
      [](onnx::ModelProto& model) { model.mutable_graph()->mutable_initializer(0)->set_dims(1, 3000); },
      [](onnx::ModelProto& model) { model.mutable_graph()->mutable_initializer(0)->set_dims(1, -3); },
      [](onnx::ModelProto& model) {
        for (int axis = 1; axis < 4; ++axis)
          model.mutable_graph()->mutable_initializer(0)->set_dims(axis, std::int64_t{1} << 40);
      },
      [](onnx::ModelProto& model) { model.mutable_graph()->mutable_initializer(0)->set_data_type(2); },
      [](onnx::ModelProto& model) { model.mutable_graph()->mutable_output(0)->set_name("depth"); },
      [](onnx::ModelProto& model) {
        model.mutable_graph()
            ->mutable_input(1)
            ->mutable_type()
            ->mutable_tensor_type()
            ->mutable_shape()
            ->mutable_dim(1)
            ->set_dim_value(5);
      },
      [](onnx::ModelProto& model) { model.mutable_graph()->mutable_node(2)->set_op_type("Nothing"); },
      [](onnx::ModelProto& model) { model.mutable_graph()->mutable_node(3)->set_input(0, "gone"); }};
  for (const auto& damage : damages) {
    onnx::ModelProto model = small_network();
    damage(model);
    files.push_back(model.SerializeAsString());
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    write_file(scratch_ / "model.onnx", files[i]);
    EXPECT_EQ(predict(read), 1) << i << said_;
    EXPECT_THAT(said_, testing::HasSubstr("damaged")) << i;
    EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 1) << i << said_;
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/predict.yaml"));
  }
}

TEST_F(Predict, RefusesFlagsThatDoNotGoTogether) {
  EXPECT_EQ(predict("--images a.png"), 2);
  EXPECT_THAT(said_, testing::HasSubstr("--background"));
  EXPECT_EQ(predict("--images a.png a.png --background background.png"), 2);
  EXPECT_THAT(said_, testing::HasSubstr("two are called a"));
  write_exr(scratch_ / "map.exr", FloatImage(kWidth, kHeight, 1), {"Y"});
  EXPECT_EQ(predict("--images a.png --background background.png --truth map.exr"), 2);
  EXPECT_THAT(said_, testing::HasSubstr("--truth: needs --rest"));
}

}  // namespace predict_program_test
}  // namespace tacipc
