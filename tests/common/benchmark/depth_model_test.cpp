#include "common/benchmark/depth_model.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/benchmark/image_look.h"
#include "common/image/picture.h"
#include "tests/common/benchmark/onnx_file.h"
#include "tests/common/benchmark/shaded_dents.h"
#include "tests/common/benchmark/small_depth_model.h"
#include "tests/common/memory_limit.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace depth_model_test {

TrainedLook some_look(int reduction = 1) {
  const MadeUpLamps lamps;
  std::vector<std::vector<ImageLook>> groups;
  for (std::size_t i = 0; i < 6; ++i)
    groups.push_back({look_of(means_over_squares(shaded_image(lamps, i, false), 1),
                              means_over_squares(shaded_image(lamps, i, true), 1))});
  return TrainedLook::of(groups, reduction);
}

std::string refusal_of(const std::string& bytes) {
  return message_of<DataError>([&] { DepthModel::from_onnx(bytes, "model.onnx"); });
}

const char* const kRefused = "model.onnx: is damaged, or not a network that depthnet wrote";

TEST(DepthModel, IsTheSameWhenRead) {
  for (const NetworkConfig config : {NetworkConfig{.levels = 1, .base_channels = 1, .reduction = 1},
                                     NetworkConfig{.levels = 3, .base_channels = 4, .reduction = 3},
                                     NetworkConfig{.levels = 6, .base_channels = 2, .reduction = 16}})
    for (const auto& [width, height] : {std::pair(31, 22), std::pair(320, 240), std::pair(1, 1)}) {
      DepthModel model{
          .network = config, .rows = height, .columns = width, .convolutions = {}, .look = some_look(config.reduction)};
      struct Counts : NetworkWriter {
        void begin(double, double, int) override {}
        void convolution(int in, int out, int taps, bool) override {
          all.push_back({.weights = std::vector<float>(static_cast<std::size_t>(in) * out * taps * taps),
                         .biases = std::vector<float>(static_cast<std::size_t>(out))});
        }
        void halve() override {}
        void keep(int) override {}
        void enlarge_and_join(int) override {}
        void end() override {}
        std::vector<Convolution> all;
      } counts;
      write_unet(config, counts);
      float number = 0.5F;
      for (Convolution& convolution : counts.all)
        for (std::vector<float>* numbers : {&convolution.weights, &convolution.biases})
          for (float& value : *numbers) value = (number *= -1.0001F);
      model.convolutions = counts.all;
      const std::string bytes = model.to_onnx();
      const DepthModel read = DepthModel::from_onnx(bytes, "model.onnx");
      EXPECT_EQ(read.network, config);
      EXPECT_EQ(read.rows, height);
      EXPECT_EQ(read.columns, width);
      EXPECT_EQ(read.convolutions, model.convolutions);
      ASSERT_TRUE(read.look);
      EXPECT_EQ(read.look->to_text(), model.look->to_text());
      EXPECT_EQ(read.to_onnx(), bytes);
    }
}

TEST(DepthModel, ReadsFilesOfEarlierVersionsWithoutDigestAndLook) {
  onnx::ModelProto model;
  ASSERT_TRUE(model.ParseFromString(small_depth_model(8, 6).to_onnx()));
  model.clear_metadata_props();
  const DepthModel read = DepthModel::from_onnx(model.SerializeAsString(), "model.onnx");
  EXPECT_EQ(read.convolutions, small_depth_model(8, 6).convolutions);
  EXPECT_FALSE(read.look);
}

TEST(DepthModel, RefusesEveryChangedByte) {
  const std::string whole = small_depth_model(8, 6).to_onnx();
  ASSERT_EQ(refusal_of(whole), "");
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const int mask : {0x01, 0x80}) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ mask);
      EXPECT_NE(refusal_of(bytes), "") << "byte " << at << " of " << whole.size() << " with " << mask;
    }
  for (std::size_t size = 0; size < whole.size(); size += 7) EXPECT_NE(refusal_of(whole.substr(0, size)), "") << size;
}

TEST(DepthModel, RefusesEveryOtherGraphWhoeverMadeItsDigest) {
  const std::string whole = small_depth_model(8, 6).to_onnx();
  const auto external = [](onnx::ModelProto& model, const std::string& location) {
    onnx::TensorProto& weights = constant_of(model, "w0");
    weights.set_data_location(onnx::TensorProto::EXTERNAL);
    onnx::StringStringEntryProto& entry = *weights.add_external_data();
    entry.set_key("location");
    entry.set_value(location);
  };
  const std::vector<std::function<void(onnx::ModelProto&)>> changes{
      [](onnx::ModelProto& model) { model.set_producer_name("pytorch"); },
      [](onnx::ModelProto& model) { constant_of(model, "w0").set_dims(1, 3000); },
      [](onnx::ModelProto& model) { constant_of(model, "w0").set_dims(1, -3); },
      [](onnx::ModelProto& model) {
        for (int axis = 1; axis < 4; ++axis) constant_of(model, "w0").set_dims(axis, std::int64_t{1} << 40);
      },
      [](onnx::ModelProto& model) { constant_of(model, "w0").set_data_type(2); },
      [](onnx::ModelProto& model) { constant_of(model, "w0").add_float_data(1.0F); },
      [](onnx::ModelProto& model) { model.mutable_graph()->mutable_output(0)->set_name("depth"); },
      [](onnx::ModelProto& model) {
        auto* shape = model.mutable_graph()->mutable_input(1)->mutable_type()->mutable_tensor_type()->mutable_shape();
        shape->mutable_dim(1)->set_dim_value(5);
      },
      [](onnx::ModelProto& model) {
        for (int i = 0; i < 2; ++i) {
          auto* shape = model.mutable_graph()->mutable_input(i)->mutable_type()->mutable_tensor_type()->mutable_shape();
          for (const int axis : {1, 2}) shape->mutable_dim(axis)->set_dim_value(std::int64_t{1} << 40);
        }
      },
      [](onnx::ModelProto& model) { model.mutable_graph()->mutable_node(2)->set_op_type("Loop"); },
      [](onnx::ModelProto& model) { model.mutable_graph()->mutable_node(3)->set_input(0, "gone"); },
      [](onnx::ModelProto& model) { *model.mutable_graph()->add_node() = model.graph().node(2); },
      [](onnx::ModelProto& model) { model.mutable_graph()->mutable_node()->RemoveLast(); },
      [](onnx::ModelProto& model) {
        model.mutable_graph()->mutable_node(6)->mutable_attribute(0)->set_ints(0, 1 << 30);
      },
      [](onnx::ModelProto& model) { model.mutable_graph()->mutable_node(6)->add_attribute()->mutable_g(); },
      [](onnx::ModelProto& model) { *model.add_metadata_props() = {}; },
      [](onnx::ModelProto& model) { model.mutable_graph()->clear_input(); },
      [](onnx::ModelProto& model) { model.clear_graph(); },
      [](onnx::ModelProto& model) { model.GetReflection()->MutableUnknownFields(&model)->AddVarint(99, 1); },
      [&](onnx::ModelProto& model) { external(model, "/etc/passwd"); },
      [&](onnx::ModelProto& model) { external(model, "../../weights.bin"); },
      [&](onnx::ModelProto& model) {
        constant_of(model, "w0").clear_raw_data();
        external(model, "weights.bin");
      }};
  for (std::size_t i = 0; i < changes.size(); ++i)
    EXPECT_EQ(refusal_of(changed_onnx(whole, changes[i])), kRefused) << i;
  EXPECT_EQ(refusal_of(changed_onnx(whole, [](onnx::ModelProto&) {})), "");
}

TEST(DepthModel, RefusesWeightsThatAreNoNumbers) {
  const std::string whole = small_depth_model(8, 6).to_onnx();
  const float wrong[] = {std::nanf(""), std::numeric_limits<float>::infinity(),
                         -std::numeric_limits<float>::infinity()};
  const char* const names[] = {"w0", "w3b", "w6"};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(refusal_of(changed_onnx(whole,
                                      [&](onnx::ModelProto& model) {
                                        std::string& raw = *constant_of(model, names[i]).mutable_raw_data();
                                        std::memcpy(raw.data(), &wrong[i], sizeof(float));
                                      })),
              std::string("model.onnx: is damaged: a weight of ") + names[i] + " is not finite");
}

TEST(DepthModel, RefusesStatisticsThatNoTrainingHas) {
  DepthModel model = small_depth_model(96, 72);
  model.look = some_look(2);
  EXPECT_EQ(refusal_of(model.to_onnx()), kRefused);  // of means over other squares than the network's
  const std::string text = some_look().to_text();
  const auto with = [&](const std::string& what, const std::string& instead) {
    std::string changed = text;
    const std::size_t at = changed.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    changed.replace(at, changed.find_first_of("\n,]", at + what.size()) - at, what + instead);
    return message_of<DataError>([&] { TrainedLook::from_text(changed, "model.onnx"); });
  };
  EXPECT_EQ(with("reduction: ", "1"), "");
  const std::string damaged = "model.onnx: its statistics of the training images are damaged";
  EXPECT_EQ(with("mean: [", "1e300"), damaged);
  EXPECT_EQ(with("directions: [", "1e200"), damaged);
  EXPECT_EQ(with("beside_limit: ", "1e-300"), damaged);
  EXPECT_EQ(with("mean_relief: [", ".nan"), damaged);
}

TEST(ReadDepthModel, RefusesProgramsAndFilesTooLargeUnread) {
  const ScratchFolder scratch;
  const auto refusal = [&](const std::filesystem::path& file) {
    const MemoryLimit limit(std::size_t{256} << 20);
    return message_of<DataError>([&] { read_depth_model(file); });
  };
  const std::string model = (scratch / "model.pt").string();
  for (const char* bytes : {"PK\x03\x04 an archive", "PK\x05\x06", "PK"}) {
    EXPECT_EQ(refusal(scratch.file("model.pt", bytes)),
              model +
                  ": is a program (TorchScript), which may do anything, and is not run: give "
                  "model_<width>x<height>.onnx, which depthnet writes beside it of each network that reads depth");
  }
  scratch.file("model.pt", "");
  EXPECT_THAT(refusal(scratch / "model.pt"), testing::HasSubstr("is damaged, or not a network"));
  std::filesystem::resize_file(scratch / "model.pt", std::uintmax_t{1} << 40);
  EXPECT_THAT(refusal(scratch / "model.pt"), testing::HasSubstr("has 1099511627776 bytes; no network"));
}

}  // namespace depth_model_test
}  // namespace tacipc
