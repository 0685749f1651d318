#include <fmt/core.h>
#include <gmock/gmock.h>
#include <onnx/onnx_pb.h>

#include <cstdint>
#include <vector>

#include "common/base/files.h"
#include "common/benchmark/depth_model.h"
#include "common/benchmark/trained_look.h"
#include "common/image/image.h"
#include "common/image/picture.h"
#include "common/stage/record.h"
#include "tests/common/benchmark/onnx_file.h"
#include "tests/common/benchmark/shaded_dents.h"
#include "tests/common/benchmark/small_depth_model.h"
#include "tests/fuzz/mutation.h"
#include "tests/program_test.h"

namespace tacipc {
namespace predict_program_test {

constexpr int kWidth = 8, kHeight = 6;

class Predict : public ProgramTest {
 protected:
  void SetUp() override {
    for (std::size_t i = 0; i < image_.pixels.size(); ++i) image_.pixels[i] = static_cast<std::uint8_t>(i * 37 % 256);
    write_png(scratch_ / "a.png", image_);
    write_png(scratch_ / "b.png", ByteImage(kWidth, kHeight, 3, 100));
    write_png(scratch_ / "background.png", ByteImage(kWidth, kHeight, 3, 100));
    write_model(small_depth_model(kWidth, kHeight));
  }
  void write_model(const DepthModel& model) { write_file(scratch_ / "model.onnx", model.to_onnx()); }
  /// That the model is refused, in one line, and nothing is left.
  void refuses(const std::string& reason) {
    EXPECT_EQ(predict("--images b.png --background background.png --log-level error"), 1) << said_;
    EXPECT_THAT(said_, testing::HasSubstr(reason));
    EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 1) << said_;
    for (const char* left : {"predict.yaml", "indentation", ".partial-predict"})
      EXPECT_FALSE(std::filesystem::exists(scratch_ / "out" / left)) << left;
  }
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
      EXPECT_NEAR(indentation.at(x, y, 0), 1e-3 * expected, 2e-8);
      EXPECT_NEAR(depth.at(x, y, 0), 0.02 - 1e-3 * expected, 2e-8);
    }
  const Record record = Record::from_file(scratch_ / "out/predict.yaml").section("summary");
  EXPECT_NEAR(record.section("deepest_mm").required_number("b"), 0.5, 1e-6);
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "out/indentation/b.png"));
  const std::string first = read_file(scratch_ / "out/indentation/a.exr");
  ASSERT_EQ(predict("--images a.png b.png --background background.png --threads 2"), 0) << said_;
  EXPECT_EQ(read_file(scratch_ / "out/indentation/a.exr"), first);
}

TEST_F(Predict, RefusesWhatIsNoNetworkOrDamaged) {
  const std::string whole = small_depth_model(kWidth, kHeight).to_onnx();
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
  for (const std::string& bytes : {std::string("not a network"), std::string(), whole.substr(0, whole.size() - 7),
                                   flipped, std::string("PK\3\4 an archive of TorchScript")}) {
    write_file(scratch_ / "model.onnx", bytes);
    refuses("error: model.onnx: is ");
  }
}

TEST_F(Predict, WritesNothingThatIsNoNumber) {
  const std::string whole = small_depth_model(kWidth, kHeight).to_onnx();
  write_file(scratch_ / "model.onnx", changed_onnx(whole, [](onnx::ModelProto& model) {
               constant_of(model, "w0b").set_raw_data(std::string(sizeof(float), '\xff'));
             }));
  refuses("error: model.onnx: is damaged: a weight of w0b is not finite");
  // Numbers that are finite, and their products not.
  for (const std::size_t convolution : {0, 1, 5}) {
    DepthModel model = small_depth_model(kWidth, kHeight);
    for (std::size_t k = convolution; k < model.convolutions.size(); ++k)
      for (float& weight : model.convolutions[k].weights) weight = weight == 0.0F ? 0.0F : 3e38F;
    write_model(model);
    refuses("error: model.onnx: is damaged: its depth of b.png is not finite");
  }
}

TEST_F(Predict, ReadsNoFileThatANetworkNames) {
  const std::string whole = small_depth_model(kWidth, kHeight).to_onnx();
  const std::string zeros(54 * sizeof(float), '\0');
  std::filesystem::create_directories(scratch_ / "beside");
  write_file(scratch_ / "weights.bin", zeros);
  write_file(scratch_ / "beside/weights.bin", zeros);
  for (const std::string& location :
       {std::string("weights.bin"), std::string("beside/../weights.bin"), (scratch_ / "weights.bin").string()}) {
    write_file(scratch_ / "model.onnx", changed_onnx(whole, [&](onnx::ModelProto& model) {
                 onnx::TensorProto& weights = constant_of(model, "w0");
                 weights.clear_raw_data();
                 weights.set_data_location(onnx::TensorProto::EXTERNAL);
                 onnx::StringStringEntryProto& entry = *weights.add_external_data();
                 entry.set_key("location");
                 entry.set_value(location);
               }));
    refuses("error: model.onnx: is damaged, or not a network that depthnet wrote");
  }
}

TEST_F(Predict, SaysOneLineOfAnyDamage) {
  const std::string whole = small_depth_model(kWidth, kHeight).to_onnx();
  Mutation mutation({whole}, 2 * whole.size());
  for (int i = 0; i < 20; ++i) {
    const std::string bytes = mutation.next();
    if (bytes == whole) continue;
    write_file(scratch_ / "model.onnx", bytes);
    refuses("error: model.onnx: is ");
  }
}

TEST_F(Predict, EndsOnLittleMemory) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer itself reserves terabytes";
#endif
  int read = 0;
  for (const int megabytes : {100, 140, 180, 220, 260, 400}) {
    std::filesystem::remove_all(scratch_ / "out");
    const int code =
        run_command(fmt::format("cd '{}' && unset OPENBLAS_NUM_THREADS && ulimit -v {}000 && timeout -s KILL 60 "
                                "'{}/predict' --out out --model model.onnx "
                                "--images a.png b.png --background background.png --log-level error",
                                (scratch_ / "").string(), megabytes, TACIPC_BIN_DIR));
    EXPECT_EQ(code == 0, std::filesystem::exists(scratch_ / "out/predict.yaml")) << megabytes;
    if (code == 0)
      ++read;
    else if (code == 1)
      EXPECT_THAT(said_, testing::HasSubstr("predict: error: out of memory")) << megabytes;
    else  // the system's loader and OpenBLAS's, before the program begins
      EXPECT_THAT(said_, testing::AnyOf(testing::HasSubstr("error while loading shared libraries"),
                                        testing::HasSubstr("OpenBLAS blas_thread_init")))
          << megabytes << ": ended with " << code;
  }
  EXPECT_GT(read, 0);
}

/// Photographs beside a network that knows what it was trained on.
class PredictCompared : public Predict {
 protected:
  void SetUp() override {
    std::vector<std::vector<ImageLook>> groups;
    for (std::size_t i = 0; i < 20; ++i)
      groups.push_back({look_of(means_over_squares(shaded_image(lamps_, i, false), 1),
                                means_over_squares(shaded_image(lamps_, i, true), 1))});
    model_ = small_depth_model(96, 72);
    model_.look = TrainedLook::of(groups, 1);
    write_model(model_);
    write("background", shaded_image(lamps_, 50, false));
    for (std::size_t i = 0; i < 3; ++i) write(fmt::format("touch_{}", i), shaded_image(lamps_, 50 + i, true));
  }
  void write_look(const std::string& text) {
    write_file(scratch_ / "model.onnx", changed_onnx(model_.to_onnx(), [&](onnx::ModelProto& model) {
                 model.mutable_metadata_props(0)->set_value(text);
               }));
  }
  void write(const std::string& name, const ByteImage& image) { write_png(scratch_ / (name + ".png"), image); }
  void write_swapped(const std::string& name) {
    ByteImage image = read_png(scratch_ / (name + ".png"), 3);
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) std::swap(image.pixels[i], image.pixels[i + 2]);
    write(name, image);
  }
  Record summary() { return Record::from_file(scratch_ / "out/predict.yaml").section("summary"); }

  MadeUpLamps lamps_;
  DepthModel model_;
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
  const std::string look = model_.look->to_text();
  DepthModel without = model_;
  without.look.reset();
  write_model(without);
  ASSERT_EQ(predict(read), 0) << said_;
  const std::string what = "model.onnx: does not say what its training's images looked like";
  EXPECT_THAT(said_, testing::HasSubstr(what));
  EXPECT_EQ(said_.find(what), said_.rfind(what));
  EXPECT_EQ(predict(read + " --strict"), 1);
  EXPECT_THAT(said_, testing::HasSubstr(what));
  for (const std::string& damaged : {look.substr(0, 2000), std::string("{}"), look + "another: 1\n"}) {
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
