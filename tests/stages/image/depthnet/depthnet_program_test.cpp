#include <fmt/core.h>
#include <gmock/gmock.h>
#include <torch/script.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/format/csv.h"
#include "common/stage/record.h"
#include "stages/image/depthnet/network.h"
#include "stages/image/depthnet/scores.h"
#include "tests/fuzz/mutation.h"
#include "tests/program_test.h"
#include "tests/stages/image/depthnet/dents.h"
#include "tests/stages/image/depthnet/grasps.h"

namespace tacipc {
namespace depthnet_program_test {

class Depthnet : public ProgramTest {
 protected:
  void SetUp() override { stay_in_this_thread(); }
  int depthnet(const std::string& flags) { return run("depthnet", flags); }
  int predict(const std::string& flags) { return run("predict", flags); }
  int run(const char* program, const std::string& flags) {
    return run_command(
        fmt::format("'{}/{}' --out '{}' {}", TACIPC_BIN_DIR, program, (scratch_ / "out").string(), flags));
  }
  std::filesystem::path write_images(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const DepthImage image = dent(i);
      write_png(scratch_ / fmt::format("dent_{}.png", i), image.image);
      write_png(scratch_ / "background.png", image.reference);
    }
    return scratch_ / "background.png";
  }
  /// A folder as render writes it, with this dent as its second frame.
  std::filesystem::path write_render(std::size_t index) {
    std::filesystem::path folder = scratch_ / fmt::format("render_{}", index);
    DepthImage image = dent(index);
    for (const char* frame : {"frame_0000", "frame_0001"}) std::filesystem::create_directories(folder / frame);
    write_png(folder / "frame_0000/tactile.png", image.reference);
    write_png(folder / "frame_0001/tactile.png", image.image);
    for (float& depth : image.depth_mm.pixels) depth *= 1e-3F;
    write_exr(folder / "frame_0001/indentation.exr", image.depth_mm, {"Y"});
    return folder;
  }
};

TEST_F(Depthnet, TrainsOnRenderFoldersAndReadsPhotographs) {
  std::string folders;
  for (std::size_t i = 0; i < 6; ++i) folders += fmt::format(" '{}'", write_render(i).string());
  write_file(scratch_ / "net.yaml", kSmall);
  const std::string flags = fmt::format("--config '{}' --renders {} --validation '{}'",
                                        (scratch_ / "net.yaml").string(), folders, write_render(50).string());
  ASSERT_EQ(depthnet(flags), 0) << said_;
  const Record summary = Record::from_file(scratch_ / "out/depthnet.yaml").section("summary");
  EXPECT_EQ(summary.required_count("images"), 6);
  EXPECT_EQ(summary.required_count("validation_images"), 1);
  EXPECT_EQ(summary.section("unlike_training").required_count("of"), 1);
  EXPECT_EQ(summary.section("unlike_training").required_count("images"), 0);
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "out/history.csv"));
  std::filesystem::rename(scratch_ / "out/model.pt", scratch_ / "model.pt");
  ASSERT_EQ(depthnet(flags + " --threads 1"), 0) << said_;
  EXPECT_EQ(read_file(scratch_ / "out/model.pt"), read_file(scratch_ / "model.pt"));
  // As PyTorch reads it.
  const torch::jit::Module script = torch::jit::load((scratch_ / "model.pt").string());
  std::filesystem::rename(scratch_ / "out/model_36x36.onnx", scratch_ / "model.onnx");

  const std::filesystem::path background = write_images(2);
  FloatImage rest(kSize, kSize, 1, 0.049F);
  write_exr(scratch_ / "rest.exr", rest, {"Y"});
  ASSERT_EQ(
      predict(fmt::format(
          "--model '{0}model.onnx' --background '{1}' --images '{0}dent_0.png' '{0}dent_1.png' --rest '{0}rest.exr'",
          (scratch_ / "").string(), background.string())),
      0)
      << said_;
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/sheet.png"));
  EXPECT_THAT(said_, testing::Not(testing::HasSubstr("warning")));
  const FloatImage indentation = read_exr(scratch_ / "out/indentation/dent_0.exr", {"Y"}),
                   depth = read_exr(scratch_ / "out/depth/dent_0.exr", {"Y"});
  const TrainedNetwork network{.file = "script", .module = script, .sizes = {{kSize, kSize}}};
  const FloatImage expected = network.depth_mm("dent_0", dent(0).image, dent(0).reference);
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    EXPECT_NEAR(indentation.pixels[i], 1e-3F * expected.pixels[i], 1e-9);
    EXPECT_NEAR(depth.pixels[i], 0.049F - indentation.pixels[i], 1e-8);
  }
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "out/indentation/dent_1.png"));
  for (const std::size_t k : {0, 1}) {
    FloatImage truth = dent(k).depth_mm;
    for (float& value : truth.pixels) value = 0.049F - 1e-3F * value;
    write_exr(scratch_ / fmt::format("true_{}.exr", k), truth, {"Y"});
  }
  const std::string read = fmt::format(
      "--model '{0}model.onnx' --background '{1}' --images '{0}dent_0.png' '{0}dent_1.png' --rest '{0}rest.exr' "
      "--truth "
      "'{0}true_0.exr' ",
      (scratch_ / "").string(), background.string());
  EXPECT_EQ(predict(read), 2);
  EXPECT_THAT(said_, testing::HasSubstr("a map for each of --images"));
  ASSERT_EQ(predict(read + fmt::format("'{}'", (scratch_ / "true_1.exr").string())), 0) << said_;
  const ByteImage sheet = read_png(scratch_ / "out/sheet.png", 3);
  ASSERT_EQ(sheet.height, 2 * kSize + 4);
  EXPECT_EQ(sheet.at(5, 7, 1), dent(0).image.at(5, 7, 1));
  // The deepest point of both truths is the lightest of the second column.
  const auto light = [&](int k, int x, int y) { return int{sheet.at(kSize + 4 + x, k * (kSize + 4) + y, 1)}; };
  int lightest = 0;
  for (int k = 0; k < 2; ++k)
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) lightest = std::max(lightest, light(k, x, y));
  const auto deepest = [](const FloatImage& map) { return std::max_element(map.pixels.begin(), map.pixels.end()); };
  const FloatImage maps[] = {dent(0).depth_mm, dent(1).depth_mm};
  const int k = *deepest(maps[1]) > *deepest(maps[0]);
  const auto at = static_cast<int>(deepest(maps[k]) - maps[k].pixels.begin());
  EXPECT_EQ(light(k, at % kSize, at / kSize), lightest);
}

TEST_F(Depthnet, RefusesWhatDoesNotBelongTogether) {
  write_images(1);
  write_file(scratch_ / "net.yaml", kSmall);
  const std::string config = fmt::format("--config '{}' ", (scratch_ / "net.yaml").string());
  EXPECT_EQ(depthnet(""), 2);
  EXPECT_THAT(said_, testing::HasSubstr("give either --config"));
  EXPECT_EQ(depthnet(config), 2);
  EXPECT_THAT(said_, testing::HasSubstr("either --shards or --renders"));
  EXPECT_EQ(depthnet(config + fmt::format("--renders '{}'", (scratch_ / "").string())), 1);
  EXPECT_THAT(said_, testing::HasSubstr("holds no frames of render"));
  write_file(scratch_ / "model.onnx", "not a network");
  const std::string model = fmt::format("--model '{}' ", (scratch_ / "model.onnx").string());
  EXPECT_EQ(depthnet(model), 2);
  EXPECT_THAT(said_, testing::HasSubstr("predict reads photographs"));
  write_shard(scratch_, {"test"});
  const std::string shards = fmt::format("--shards '{}'", (scratch_ / "shards/shards.txt").string());
  EXPECT_EQ(depthnet(model + shards), 1);
  EXPECT_THAT(said_, testing::HasSubstr("model.onnx: is damaged, or not a network that depthnet wrote"));
}

TEST_F(Depthnet, PredictRefusesImagesOfAnotherSize) {
  const std::filesystem::path background = write_images(1);
  const DepthnetConfig small = small_config();
  const auto network_for = [&](int width, int height) {
    write_file(scratch_ / "model.onnx",
               depth_model_of(make_network(small.network, 1), small.network, {height, width}).to_onnx());
  };
  const std::string photograph =
      fmt::format("--model '{0}model.onnx' --images '{0}dent_0.png' --background ", (scratch_ / "").string());
  network_for(kSize, kSize);
  write_png(scratch_ / "large.png", ByteImage(40, 40, 3));
  EXPECT_EQ(predict(photograph + fmt::format("'{}'", (scratch_ / "large.png").string())), 1);
  EXPECT_THAT(said_, testing::HasSubstr("has 36 x 36 pixels, its reference 40 x 40"));
  EXPECT_EQ(predict(photograph + fmt::format("'{}'", background.string())), 0) << said_;
  network_for(64, 48);
  EXPECT_EQ(predict(photograph + fmt::format("'{}'", background.string())), 1);
  EXPECT_THAT(said_, testing::HasSubstr("has 36 x 36 pixels; the network is for images of 64 x 48"));
}

TEST_F(Depthnet, LearnsFromADatasetAndIsJudgedByItsTestObjects) {
  write_shard(scratch_, {"train", "train", "val", "test"});
  write_file(scratch_ / "net.yaml", kSmall);
  const std::string shards = fmt::format("--shards '{}' ", (scratch_ / "shards/shards.txt").string());
  ASSERT_EQ(depthnet(shards + fmt::format("--config '{}'", (scratch_ / "net.yaml").string())), 0) << said_;
  const Record trained = Record::from_file(scratch_ / "out/depthnet.yaml");
  EXPECT_EQ(trained.section("summary").required_count("images"), 4);
  EXPECT_EQ(trained.section("summary").required_count("validation_images"), 2);
  EXPECT_THAT(read_file(scratch_ / "out/depthnet.yaml"), testing::HasSubstr("shards/one"));
  std::filesystem::rename(scratch_ / "out/model_36x36.onnx", scratch_ / "model.onnx");
  const std::string judge = shards + fmt::format("--model '{}'", (scratch_ / "model.onnx").string());
  ASSERT_EQ(depthnet(judge), 0) << said_;
  const Record judged = Record::from_file(scratch_ / "out/depthnet.yaml").section("summary").section("pressed");
  EXPECT_EQ(judged.required_count("images"), 2);
  // The same by hand.
  const TrainedNetwork network = load_network({scratch_ / "model.onnx"});
  double mean = 0.0;
  for (const std::size_t i : {6, 7}) {
    const DepthImage image = dent(i);
    const FloatImage depth = network.depth_mm(image.name, image.image, image.reference);
    double sum = 0.0, count = 0.0;
    for (std::size_t k = 0; k < depth.pixels.size(); ++k)
      if (image.depth_mm.pixels[k] > 0.02F) sum += std::abs(depth.pixels[k] - image.depth_mm.pixels[k]), count += 1.0;
    mean += 0.5 * sum / count;
  }
  EXPECT_NEAR(judged.section("mae_mm").required_number("mean"), mean, 1e-6);
  const ByteImage sheet = read_png(scratch_ / "out/sheet.png", 3);
  EXPECT_EQ(sheet.width, 4 * kSize + 12);
  EXPECT_EQ(sheet.height, 2 * kSize + 4);
  write_shard(scratch_, {"train"});
  EXPECT_EQ(depthnet(judge), 1);
  EXPECT_THAT(said_, testing::HasSubstr("shards.txt: names no images with contact of the split test"));
}

TEST_F(Depthnet, ForetellsOutcomesAlikeByOneThreadTwoThreadsAndTheScript) {
  const std::vector<MadeGrasp> made = made_grasps(8, true);
  const std::string shards = fmt::format("--shards '{}' ", write_grasps(scratch_, made).string());
  std::string net = kSmallOutcome;
  net.replace(net.find("epochs: 8"), 9, "epochs: 4");
  write_file(scratch_ / "net.yaml", net);
  const std::string flags = shards + fmt::format("--config '{}' --threads ", (scratch_ / "net.yaml").string());
  std::string first[5];
  const char* const names[] = {"model.pt", "outcome.csv", "history.csv", "roc.svg", "outcome.md"};
  for (const int threads : {1, 2}) {
    ASSERT_EQ(depthnet(flags + std::to_string(threads)), 0) << said_;
    for (std::size_t k = 0; k < std::size(names); ++k) {
      const std::string bytes = read_file(scratch_ / "out" / names[k]);
      if (threads == 1) first[k] = bytes;
      EXPECT_EQ(bytes, first[k]) << names[k];
    }
  }
  // The script of the first seed, asked with images as they are, says what the table has.
  torch::jit::Module module = torch::jit::load((scratch_ / "out/model.pt").string());
  CsvReader table(scratch_ / "out/outcome.csv");
  std::vector<double> said;
  std::vector<bool> held;
  for (std::size_t i = 32; i < made.size(); ++i) {  // the last two objects
    std::vector<torch::Tensor> images, references;
    for (std::size_t f = 0; f < 2; ++f) {
      references.push_back(tensor_of(made_image(made[i], i, f, 0)));
      for (const std::size_t t : {kClosed, kHeldStill}) images.push_back(tensor_of(made_image(made[i], i, f, t)));
    }
    const torch::Tensor answer = module
                                     .forward({torch::cat(images).reshape({1, 2, 2, kGraspSize, kGraspSize, 3}),
                                               torch::cat(references).reshape({1, 2, kGraspSize, kGraspSize, 3})})
                                     .toTensor();
    ASSERT_TRUE(table.next());
    EXPECT_EQ(table["grasp"], fmt::format("s{:03}", 2 * i));
    EXPECT_EQ(table["outcome"], made[i].outcome);
    EXPECT_NEAR(std::stod(table["network_4"]), answer.item<double>(), 1e-6);
    said.push_back(std::stod(table["network_4"]));
    held.push_back(table["held"] == "1");
  }
  EXPECT_FALSE(table.next());
  const Record summary = Record::from_file(scratch_ / "out/depthnet.yaml").section("summary");
  EXPECT_EQ(summary.section("test").required_count("grasps"), 16);
  EXPECT_NEAR(summary.section("seen").required_number("largest_slip_mm"), 0.75, 1e-6);
  EXPECT_EQ(summary.section("network").section("accuracy").numbers("seeds", 2)->front(),
            scores_of(said, held).accuracy);
}

TEST_F(Depthnet, RunsNoModelsCode) {
  write_shard(scratch_, {"test"});
  const std::string loops = R"(
def forward(self, image, reference):
    x = image
    while True:
        x = x + 1
    return x
)",
                    writes = fmt::format(R"(
def forward(self, image, reference):
    torch.save(image, "{}")
    return image.to(6).mean(3)
)",
                                         (scratch_ / "written").string());
  for (const std::string& code : {loops, writes}) {
    torch::jit::Module module("DepthFromTouch");
    module.define(code);
    module.save((scratch_ / "model.pt").string(), {{"image_sizes", fmt::format("{0} {0}\n", kSize)}});
    EXPECT_EQ(run_command(fmt::format("timeout 60 '{}/depthnet' --out '{}' --model '{}' --shards '{}'", TACIPC_BIN_DIR,
                                      (scratch_ / "out").string(), (scratch_ / "model.pt").string(),
                                      (scratch_ / "shards/shards.txt").string())),
              1);
    EXPECT_THAT(said_,
                testing::HasSubstr("model.pt: is a program (TorchScript), which may do anything, and is not run"));
    EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 1) << said_;
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "written"));
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/samples.csv"));
  }
}

TEST_F(Depthnet, RefusesScriptsHoweverDamaged) {
  torch::jit::Module module = make_network(small_config().network, 1);
  save_script(module, scratch_ / "model.pt");
  const std::string whole = read_file(scratch_ / "model.pt");
  Mutation mutation({whole}, whole.size() + 64);
  for (int i = 0; i < 1000; ++i) {
    const auto file = scratch_.file("damaged.pt", mutation.next());
    EXPECT_THAT(message_of<DataError>([&] { load_network({file}); }), testing::StartsWith(file.string() + ": is "))
        << i;
  }
}

TEST_F(Depthnet, RefusesGraspsOfOneOutcomeInOneLine) {
  std::vector<MadeGrasp> made = made_grasps(2, true);
  for (MadeGrasp& grasp : made) grasp.outcome = "lifted";
  write_file(scratch_ / "net.yaml", kSmallOutcome);
  const std::string config = fmt::format("--config '{}' ", (scratch_ / "net.yaml").string());
  EXPECT_EQ(depthnet(config + fmt::format("--shards '{}'", write_grasps(scratch_, made).string())), 1);
  EXPECT_THAT(said_, testing::HasSubstr("shards.txt: the split train has 6 grasps of 3 objects, all held: there is "
                                        "nothing to tell apart"));
  EXPECT_EQ(depthnet(config + fmt::format("--renders '{}'", (scratch_ / "").string())), 2);
  EXPECT_THAT(said_, testing::HasSubstr("takes --shards"));
}

}  // namespace depthnet_program_test
}  // namespace tacipc
