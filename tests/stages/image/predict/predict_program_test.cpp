#include <fmt/core.h>
#include <gmock/gmock.h>
#include <onnx/onnx_pb.h>

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <vector>

#include "common/base/files.h"
#include "common/benchmark/trained_look.h"
#include "common/image/image.h"
#include "common/image/picture.h"
#include "common/sample/depth_model.h"
#include "common/stage/record.h"
#include "tests/common/benchmark/shaded_dents.h"
#include "tests/program_test.h"

namespace tacipc {
namespace predict_program_test {

constexpr int kWidth = 8, kHeight = 6;

// Networks of depthnet are read in tests/stages/image/depthnet; here is the smallest there can be, by hand:
// 0.01 red − 0.02 green + 0.03 blue of the change, + 0.5 mm.
onnx::ModelProto small_network(int width = kWidth, int height = kHeight) {
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
  declare(*graph.add_input(), DepthModel::kImage, {1, height, width, 3});
  declare(*graph.add_input(), DepthModel::kReference, {1, height, width, 3});
  declare(*graph.add_output(), DepthModel::kIndentation, {1, 1, height, width});
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

/// Photographs beside a network that knows what it was trained on.
class PredictCompared : public Predict {
 protected:
  void SetUp() override {
    std::vector<std::vector<ImageLook>> groups;
    for (std::size_t i = 0; i < 20; ++i)
      groups.push_back({look_of(means_over_squares(shaded_image(lamps_, i, false), 1),
                                means_over_squares(shaded_image(lamps_, i, true), 1))});
    look_ = TrainedLook::of(groups, 1).to_text();
    model_ = small_network(96, 72);
    write_look(look_);
    write("background", shaded_image(lamps_, 50, false));
    for (std::size_t i = 0; i < 3; ++i) write(fmt::format("touch_{}", i), shaded_image(lamps_, 50 + i, true));
  }
  void write_look(const std::string& text) {
    onnx::ModelProto model = model_;
    onnx::StringStringEntryProto& entry = *model.add_metadata_props();
    entry.set_key(DepthModel::kTrainedLook);
    entry.set_value(text);
    write_model(model);
  }
  void write(const std::string& name, const ByteImage& image) { write_png(scratch_ / (name + ".png"), image); }
  void write_swapped(const std::string& name) {
    ByteImage image = read_png(scratch_ / (name + ".png"), 3);
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) std::swap(image.pixels[i], image.pixels[i + 2]);
    write(name, image);
  }
  Record summary() { return Record::from_file(scratch_ / "out/predict.yaml").section("summary"); }

  MadeUpLamps lamps_;
  std::string look_;
  onnx::ModelProto model_;
};

TEST_F(PredictCompared, SaysNothingOfPhotographsAsTrained) {
  const std::string read = "--images touch_0.png touch_1.png touch_2.png --background background.png";
  ASSERT_EQ(predict(read + " --strict"), 0) << said_;
  EXPECT_THAT(said_, testing::Not(testing::HasSubstr("unlike")));
  EXPECT_EQ(summary().section("unlike_training").required_count("images"), 0);
  EXPECT_EQ(summary().section("unlike_training").required_count("of"), 3);
  EXPECT_LT(summary().section("distance_from_training").required_number("touch_2"), 1.0);
  EXPECT_THAT(read_file(scratch_ / "out/predict.yaml"), testing::HasSubstr("strict: true"));
}

TEST_F(PredictCompared, NamesWhatDiffersAndRefusesItIfStrict) {
  const std::string read = "--images touch_0.png touch_1.png touch_2.png --background background.png";
  for (const char* name : {"touch_0", "touch_1", "touch_2", "background"}) write_swapped(name);
  ASSERT_EQ(predict(read), 0) << said_;
  EXPECT_THAT(said_,
              testing::ContainsRegex("warning.*3 of 3 photographs \\(touch_0, touch_1, touch_2\\) are unlike those "
                                     "of the training, at [0-9.]+( to [0-9.]+)? times its limit: the image and its "
                                     "background have red and blue swapped; undone, at 0\\.[0-9]"));
  EXPECT_EQ(summary().section("unlike_training").section("deviations").required_count("red_blue_swapped"), 3);
  EXPECT_GT(summary().section("distance_from_training").required_number("touch_0"), 1.0);
  EXPECT_EQ(predict(read + " --strict"), 1);
  EXPECT_THAT(said_, testing::ContainsRegex("error: model.onnx: 3 of 3 photographs"));
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/predict.yaml"));
  // One alone.
  for (const char* name : {"touch_0", "touch_1", "background"}) write_swapped(name);
  ASSERT_EQ(predict(read), 0) << said_;
  EXPECT_THAT(said_, testing::HasSubstr("1 of 3 photographs (touch_2) "));
  EXPECT_EQ(summary().section("unlike_training").section("deviations").required_count("image_red_blue_swapped"), 1);
}

TEST_F(PredictCompared, SaysOnceThatItCannotCompare) {
  const std::string read = "--images touch_0.png touch_1.png --background background.png";
  write_model(model_);
  ASSERT_EQ(predict(read), 0) << said_;
  const std::string what = "model.onnx: does not say what its training's images looked like";
  EXPECT_THAT(said_, testing::HasSubstr(what));
  EXPECT_EQ(said_.find(what), said_.rfind(what));
  EXPECT_EQ(predict(read + " --strict"), 1);
  EXPECT_THAT(said_, testing::HasSubstr(what));
  for (const std::string& damaged : {look_.substr(0, 2000), std::string("{}"), look_ + "another: 1\n"}) {
    write_look(damaged);
    EXPECT_EQ(predict(read), 1);
    EXPECT_THAT(said_, testing::HasSubstr("model.onnx: its statistics of the training images are damaged"));
  }
}

TEST_F(PredictCompared, RefusesPhotographsOfAnotherSizeByBothSizes) {
  write("turned", shaded_image(lamps_, 51, true, 72, 96));
  write("small", shaded_image(lamps_, 51, true, 48, 36));
  for (const char* name : {"turned", "small"}) {
    EXPECT_EQ(predict(fmt::format("--images {0}.png --background {0}.png", name)), 1);
    EXPECT_THAT(said_, testing::HasSubstr("the network is for images of 96 x 72"));
    EXPECT_EQ(said_.find("is it turned by 90°?") != std::string::npos, name == std::string("turned")) << said_;
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
