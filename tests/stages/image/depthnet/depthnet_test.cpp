#include <fmt/core.h>
#include <gmock/gmock.h>
#include <tbb/global_control.h>
#include <torch/csrc/autograd/autograd.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/rng.h"
#include "common/base/sha256.h"
#include "common/format/hdf5_writer.h"
#include "common/stage/record.h"
#include "stages/image/depthnet/train.h"
#include "tests/config_text.h"
#include "tests/program_test.h"

namespace tacipc {
namespace {

constexpr int kSize = 36;

/// Smooth dents, one an image, lit from three sides: codes change with the slope, as a gel's do.
DepthImage dent(std::size_t index) {
  const auto draw = [&](std::uint64_t counter) { return random_uniform(5, index, counter); };
  const double x0 = 10.0 + 16.0 * draw(0), y0 = 10.0 + 16.0 * draw(1), radius = 5.0 + 4.0 * draw(2),
               deep = 0.3 + 0.6 * draw(3);
  DepthImage out{.name = fmt::format("dent_{}", index),
                 .split = "train",
                 .image = ByteImage(kSize, kSize, 3),
                 .reference = ByteImage(kSize, kSize, 3, 120),
                 .depth_mm = FloatImage(kSize, kSize, 1)};
  const auto depth = [&](double x, double y) {
    const double r2 = ((x - x0) * (x - x0) + (y - y0) * (y - y0)) / (radius * radius);
    return r2 < 1.0 ? deep * (1.0 - r2) * (1.0 - r2) : 0.0;
  };
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      out.depth_mm.at(x, y, 0) = static_cast<float>(depth(x, y));
      const double sx = 0.5 * (depth(x + 1, y) - depth(x - 1, y)), sy = 0.5 * (depth(x, y + 1) - depth(x, y - 1));
      for (int c = 0; c < 3; ++c) {
        const double angle = 2.0 * std::numbers::pi * c / 3.0;
        out.image.at(x, y, c) =
            static_cast<std::uint8_t>(120.5 + 350.0 * (std::cos(angle) * sx + std::sin(angle) * sy));
      }
    }
  return out;
}

const char* const kSmall = R"(
network: {levels: 2, base_channels: 6, reduction: 1}
loss: {kind: mae, contact_weight: 2, slope_weight: 0.5}
schedule: {epochs: 25, batch: 4, learning_rate: 0.005, warmup_epochs: 1, weight_decay: 0.0001, gradient_norm: 1}
augmentation: {gain: 0.05, drift_codes: 2, noise_codes: 1, reference_codes: 4, shift_px: 2}
frames: all
seed: 3
)";

DepthnetConfig small_config(int epochs = 25) {
  auto config = config_from_text<DepthnetConfig>(kSmall, "small.yaml");
  config.schedule.epochs = epochs;
  return config;
}

std::vector<DepthItem> dents(const torch::jit::Module& network, std::size_t begin, std::size_t count) {
  std::vector<DepthItem> items;
  for (std::size_t i = begin; i < begin + count; ++i) items.push_back(item_of(dent(i), network, 1));
  return items;
}

const Checkpoints kNoCheckpoints{.load = [] { return std::optional<std::string>(); },
                                 .save = [](const std::string&) {}};

std::vector<float> numbers_of(const torch::jit::Module& network) {
  std::vector<float> numbers;
  for (const torch::Tensor& weight : weights_of(network))
    numbers.insert(numbers.end(), weight.data_ptr<float>(), weight.data_ptr<float>() + weight.numel());
  return numbers;
}

class Depthnet : public ProgramTest {
 protected:
  void SetUp() override { stay_in_this_thread(); }
  int depthnet(const std::string& flags) {
    return run_command(fmt::format("'{}/depthnet' --out '{}' {}", TACIPC_BIN_DIR, (scratch_ / "out").string(), flags));
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
    const std::filesystem::path folder = scratch_ / fmt::format("render_{}", index);
    DepthImage image = dent(index);
    for (const char* frame : {"frame_0000", "frame_0001"}) std::filesystem::create_directories(folder / frame);
    write_png(folder / "frame_0000/tactile.png", image.reference);
    write_png(folder / "frame_0001/tactile.png", image.image);
    for (float& depth : image.depth_mm.pixels) depth *= 1e-3F;
    write_exr(folder / "frame_0001/indentation.exr", image.depth_mm, {"Y"});
    return folder;
  }
};

TEST_F(Depthnet, LearnsDepthFromShadingAndNotFromShuffledPairs) {
  DepthnetConfig config = small_config();
  double errors[2], mean_depth_error = 0.0;
  for (const bool shuffled : {false, true}) {
    torch::jit::Module network = make_network(config.network, config.seed);
    std::vector<DepthItem> items = dents(network, 0, 32);
    const std::vector<DepthItem> others = dents(network, 100, 12);
    if (shuffled) shuffle_depths(items, config.seed);
    const auto rows = train(network, items, others, config, kNoCheckpoints);
    ASSERT_EQ(rows.size(), 25U);
    EXPECT_EQ(rows.back().validation_mae_contact_mm, errors_of(network, others).mae_contact_mm());
    errors[shuffled] = rows.back().validation_mae_contact_mm;
  }
  // Always answering the mean depth in contact.
  double sum = 0.0, count = 0.0;
  const auto each_in_contact = [](const auto& take) {
    for (std::size_t i = 100; i < 112; ++i)
      for (const float depth : dent(i).depth_mm.pixels)
        if (depth > kContactMm) take(depth);
  };
  each_in_contact([&](double depth) { sum += depth, ++count; });
  each_in_contact([&](double depth) { mean_depth_error += std::abs(depth - sum / count) / count; });
  EXPECT_LT(errors[0], 0.35 * mean_depth_error);
  EXPECT_GT(errors[1], 2.0 * errors[0]);
}

TEST_F(Depthnet, WeightsDependNeitherOnThreadsNorOnInterruptions) {
  const DepthnetConfig config = small_config(4);
  const auto trained = [&](std::size_t threads, const Checkpoints& checkpoints) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    torch::jit::Module network = make_network(config.network, config.seed);
    const std::vector<DepthItem> items = dents(network, 0, 10);
    const auto rows = train(network, items, {}, config, checkpoints);
    EXPECT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows.back().epoch, 4.0);
    return numbers_of(network);
  };
  const std::vector<float> alone = trained(1, kNoCheckpoints);
  EXPECT_EQ(trained(3, kNoCheckpoints), alone);
  std::optional<std::string> kept;
  int saved = 0;
  const Checkpoints keeping{.load = [&] { return kept; },
                            .save =
                                [&](const std::string& bytes) {
                                  kept = bytes;
                                  if (++saved == 2) throw DataError("interrupted");
                                },
                            .between = std::chrono::seconds(0)};
  EXPECT_THROW(trained(2, keeping), DataError);
  EXPECT_EQ(trained(2, keeping), alone);
}

TEST_F(Depthnet, EnlargesItsAnswerToTheImageAndIsTheSameWhenRead) {
  for (const int reduction : {1, 2, 3}) {
    const torch::jit::Module module = make_network({.levels = 2, .base_channels = 6, .reduction = reduction}, 1);
    ByteImage image(31, 22, 3, 90), reference(31, 22, 3, 100);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(60 + i % 97);
    save_network({.module = module, .sizes = {{22, 31}, {48, 64}}}, scratch_ / "model.pt");
    const TrainedNetwork network = load_network(scratch_ / "model.pt");
    EXPECT_EQ(network.sizes, (std::vector<ImageSize>{{22, 31}, {48, 64}}));
    const FloatImage depth = network.depth_mm("a", image, reference);
    // Means over squares of the answer are the network's own but at its border: enlarging keeps what is linear.
    const torch::NoGradGuard no_gradients;
    const torch::Tensor small =
        module
            .get_method("indentation")(
                {module.get_method("reduced")({tensor_of(image), tensor_of(reference)}).toTensor()})
            .toTensor()[0][0];
    ASSERT_EQ(small.size(0), (22 + reduction - 1) / reduction);
    ASSERT_EQ(small.size(1), (31 + reduction - 1) / reduction);
    for (int y = 0; y < 22; ++y)
      for (int x = 0; x < 31; ++x) {
        // The nearest pixels of the network's, by the place of the centre.
        const double u = std::max(0.0, (x + 0.5) / reduction - 0.5), v = std::max(0.0, (y + 0.5) / reduction - 0.5);
        const auto at = [&](int j, int i) {
          return double{
              small[std::min<std::int64_t>(j, small.size(0) - 1)][std::min<std::int64_t>(i, small.size(1) - 1)]
                  .item<float>()};
        };
        const int i = static_cast<int>(u), j = static_cast<int>(v);
        const double p = u - i, q = v - j;
        EXPECT_NEAR(
            depth.at(x, y, 0),
            (1 - q) * ((1 - p) * at(j, i) + p * at(j, i + 1)) + q * ((1 - p) * at(j + 1, i) + p * at(j + 1, i + 1)),
            1e-5)
            << reduction << ' ' << x << ' ' << y;
      }
  }
  EXPECT_THROW(load_network(scratch_ / "model.pt").depth_mm("a", ByteImage(30, 22, 3), ByteImage(30, 22, 3)),
               DataError);
}

TEST(DepthItem, IsMeansOverSquaresAndKnowWhatIsBesideTheGel) {
  const torch::jit::Module network = make_network({.levels = 1, .base_channels = 1, .reduction = 2}, 1);
  DepthImage image{.name = "a",
                   .image = ByteImage(3, 2, 3, 10),
                   .reference = ByteImage(3, 2, 3, 8),
                   .depth_mm = FloatImage(3, 2, 1, 0.5F)};
  image.image.at(0, 0, 1) = 30;  // one of four
  image.depth_mm.at(2, 1, 0) = std::nanf("");
  image.depth_mm.at(1, 1, 0) = 0.9F;
  const DepthItem item = item_of(image, network, 2);
  ASSERT_EQ(item.change.sizes(), (std::vector<std::int64_t>{3, 1, 2}));
  EXPECT_EQ(item.change[0][0][0].item<float>(), 2.0F);
  EXPECT_EQ(item.change[1][0][0].item<float>(), 7.0F);
  EXPECT_EQ(item.change[1][0][1].item<float>(), 2.0F);  // a half square at the border
  EXPECT_EQ(item.reference[2][0][1].item<float>(), 8.0F);
  EXPECT_NEAR(item.depth_mm[0][0][0].item<float>(), 0.6, 1e-3);
  EXPECT_TRUE(std::isnan(item.depth_mm[0][0][1].item<float>()));
  for (float& depth : image.depth_mm.pixels) depth = std::nanf("");
  EXPECT_THROW(item_of(image, network, 2), DataError);
}

TEST(Augmentation, MovesImageReferenceAndDepthTogether) {
  const torch::jit::Module network = make_network({.levels = 1, .base_channels = 1, .reduction = 1}, 1);
  const DepthItem item = item_of(dent(0), network, 1);
  const DepthExample plain = example_of(item);
  EXPECT_TRUE(augmented(item, {}, 1, 1, 0).input.equal(plain.input));
  const AugmentationConfig shifts{.shift_px = 3};
  bool moved = false;
  for (int epoch = 1; epoch < 6; ++epoch) {
    const DepthExample example = augmented(item, shifts, 1, epoch, 0);
    EXPECT_EQ(example.input.sizes(), plain.input.sizes());
    // The largest depth and the largest change have moved by the same vector.
    const auto top = [](const torch::Tensor& image) { return image.argmax().item<std::int64_t>(); };
    const auto by = top(example.depth_mm[0][0]) - top(plain.depth_mm[0][0]);
    EXPECT_EQ(top(example.input[0][0]) - top(plain.input[0][0]), by);
    EXPECT_LE(std::abs(std::lround(static_cast<double>(by) / kSize)), 3);
    moved = moved || by != 0;
  }
  EXPECT_TRUE(moved);
  // Gains and drifts stay within their sizes, and differ between epochs.
  const AugmentationConfig light{.gain = 0.1, .drift_codes = 4.0};
  const torch::Tensor first = augmented(item, light, 1, 1, 0).input, second = augmented(item, light, 1, 2, 0).input;
  EXPECT_FALSE(first.equal(second));
  const torch::Tensor limit = 0.1 * plain.input.narrow(1, 0, 3).abs() + 4.001;
  EXPECT_TRUE(((first - plain.input).narrow(1, 0, 3).abs() <= limit).all().item<bool>());
  EXPECT_TRUE((first - plain.input).narrow(1, 3, 3).eq(0).all().item<bool>());
}

TEST(Loss, IsTheWeightedMeanErrorWithItsSlopes) {
  const float nan = std::nanf("");
  const torch::Tensor truth = torch::tensor({0.0F, 0.5F, nan}).expand({1, 1, 2, 3});
  const torch::Tensor said = torch::tensor({0.1F, 0.8F, 9.0F}).repeat({1, 1, 2, 1}).requires_grad_(true);
  EXPECT_NEAR(loss_of(said, truth, {.contact_weight = 2.0}).item<double>(), (0.1 + 3 * 0.3) / 4, 1e-6);
  EXPECT_NEAR(loss_of(said, truth, {.squared = true}).item<double>(), (0.01 + 0.09) / 2, 1e-6);
  // Errors 0.1 and 0.3, and none beside the gel, in both rows: slopes of 0.2 and -0.3.
  const torch::Tensor loss = loss_of(said, truth, {.slope_weight = 1.0});
  EXPECT_NEAR(loss.item<double>(), 0.2 + 0.25, 1e-6);
  EXPECT_EQ(torch::autograd::grad({loss}, {said})[0][0][0][0][2].item<float>(), 0.0F);
  EXPECT_THROW(loss_of(said, torch::full({1, 1, 1, 3}, nan), {}), DataError);
}

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
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "out/history.csv"));
  std::filesystem::rename(scratch_ / "out/model.pt", scratch_ / "model.pt");
  ASSERT_EQ(depthnet(flags + " --threads 1"), 0) << said_;
  EXPECT_EQ(read_file(scratch_ / "out/model.pt"), read_file(scratch_ / "model.pt"));

  const std::filesystem::path background = write_images(2);
  FloatImage rest(kSize, kSize, 1, 0.049F);
  write_exr(scratch_ / "rest.exr", rest, {"Y"});
  ASSERT_EQ(
      depthnet(fmt::format(
          "--model '{0}model.pt' --background '{1}' --images '{0}dent_0.png' '{0}dent_1.png' --rest '{0}rest.exr'",
          (scratch_ / "").string(), background.string())),
      0)
      << said_;
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/sheet.png"));
  const FloatImage indentation = read_exr(scratch_ / "out/indentation/dent_0.exr", {"Y"}),
                   depth = read_exr(scratch_ / "out/depth/dent_0.exr", {"Y"});
  const FloatImage expected = load_network(scratch_ / "model.pt").depth_mm("dent_0", dent(0).image, dent(0).reference);
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    EXPECT_FLOAT_EQ(indentation.pixels[i], 1e-3F * expected.pixels[i]);
    EXPECT_NEAR(depth.pixels[i], 0.049F - indentation.pixels[i], 1e-8);
  }
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "out/indentation/dent_1.png"));
  for (const std::size_t k : {0, 1}) {
    FloatImage truth = dent(k).depth_mm;
    for (float& value : truth.pixels) value = 0.049F - 1e-3F * value;
    write_exr(scratch_ / fmt::format("true_{}.exr", k), truth, {"Y"});
  }
  const std::string read = fmt::format(
      "--model '{0}model.pt' --background '{1}' --images '{0}dent_0.png' '{0}dent_1.png' --rest '{0}rest.exr' --truth "
      "'{0}true_0.exr' ",
      (scratch_ / "").string(), background.string());
  EXPECT_EQ(depthnet(read), 2);
  EXPECT_THAT(said_, testing::HasSubstr("a map for each of --images"));
  ASSERT_EQ(depthnet(read + fmt::format("'{}'", (scratch_ / "true_1.exr").string())), 0) << said_;
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
  const std::filesystem::path background = write_images(1);
  write_file(scratch_ / "net.yaml", kSmall);
  const std::string config = fmt::format("--config '{}' ", (scratch_ / "net.yaml").string()),
                    photograph = fmt::format("'{}'", (scratch_ / "dent_0.png").string());
  EXPECT_EQ(depthnet(""), 2);
  EXPECT_THAT(said_, testing::HasSubstr("give either --config"));
  EXPECT_EQ(depthnet(config), 2);
  EXPECT_THAT(said_, testing::HasSubstr("either --shards or --renders"));
  EXPECT_EQ(depthnet(config + "--images " + photograph), 2);
  EXPECT_EQ(depthnet(config + fmt::format("--renders '{}'", (scratch_ / "").string())), 1);
  EXPECT_THAT(said_, testing::HasSubstr("holds no frames of render"));
  write_file(scratch_ / "model.pt", "not a network");
  const std::string model = fmt::format("--model '{}' --images {} ", (scratch_ / "model.pt").string(), photograph);
  EXPECT_EQ(depthnet(model), 2);
  EXPECT_THAT(said_, testing::HasSubstr("--background"));
  EXPECT_EQ(depthnet(model + fmt::format("--background '{}'", background.string())), 1);
  EXPECT_THAT(said_, testing::HasSubstr("model.pt: is not a network that depthnet wrote"));
  const DepthnetConfig small = small_config();
  save_network({.module = make_network(small.network, 1), .sizes = {{kSize, kSize}}}, scratch_ / "model.pt");
  write_png(scratch_ / "large.png", ByteImage(40, 40, 3));
  EXPECT_EQ(depthnet(model + fmt::format("--background '{}'", (scratch_ / "large.png").string())), 1);
  EXPECT_THAT(said_, testing::HasSubstr("has 36 x 36 pixels, its reference 40 x 40"));
  EXPECT_EQ(depthnet(model + fmt::format("--background '{}'", background.string())), 0) << said_;
  save_network({.module = make_network(small.network, 1), .sizes = {{48, 64}}}, scratch_ / "model.pt");
  EXPECT_EQ(depthnet(model + fmt::format("--background '{}'", background.string())), 1);
  EXPECT_THAT(said_, testing::HasSubstr("has 36 x 36 pixels; the network was trained on images of 64 x 48"));
  write_file(scratch_ / "list.txt", "a/pack.yaml\n");
  EXPECT_EQ(depthnet(fmt::format("--model '{0}' --shards '{1}' --background '{2}'", (scratch_ / "model.pt").string(),
                                 (scratch_ / "list.txt").string(), background.string())),
            2);
  EXPECT_THAT(said_, testing::HasSubstr("go with --images"));
}

/// A shard as pack writes it: samples 0 … of three frames, the first without contact.
std::filesystem::path write_shard(const ScratchFolder& scratch, const std::vector<std::string>& splits,
                                  NumberType depth_type = NumberType::f32) {
  const std::filesystem::path file = scratch / "shards/one/one.h5";
  std::filesystem::create_directories(file.parent_path());
  {
    Hdf5Writer writer(file);
    for (std::size_t i = 0; i < splits.size(); ++i) {
      const std::string sample = fmt::format("/data/s{}", i);
      writer.group(sample + "/obs");
      writer.attribute(sample, "split", splits[i]);
      const std::vector<DepthImage> touched{dent(2 * i), dent(2 * i + 1)};
      std::string rgb(touched[0].reference.pixels.begin(), touched[0].reference.pixels.end());
      std::vector<double> depth(kSize * kSize, 0.0);
      for (const DepthImage& image : touched) {
        rgb.append(image.image.pixels.begin(), image.image.pixels.end());
        depth.insert(depth.end(), image.depth_mm.pixels.begin(), image.depth_mm.pixels.end());
      }
      writer.write(sample + "/obs/rgb", NumberType::u8, {3, kSize, kSize, 3}, rgb);
      writer.write(sample + "/obs/indentation_mm", depth_type, {3, kSize, kSize}, to_bytes(depth_type, depth));
    }
    writer.close();
  }
  write_file(scratch / "shards/one/one.h5.sha256", sha256_of_file(file) + "  one.h5\n");
  write_file(scratch / "shards/one/pack.yaml", "stage: pack\n");
  write_file(scratch / "shards/shards.txt", "one/pack.yaml\n");
  return file;
}

TEST_F(Depthnet, ReadsTheSplitsOfAShard) {
  const std::filesystem::path shard = write_shard(scratch_, {"train", "val", "test", "train"});
  std::vector<std::string> names;
  read_packed(shard, {"train", "val"}, false, [&](const DepthImage& image) {
    names.push_back(image.split + " " + image.name);
    const DepthImage expected = dent(names.size() == 1   ? 0
                                     : names.size() == 2 ? 1
                                     : names.size() < 5  ? names.size() - 1
                                                         : names.size() + 1);
    EXPECT_EQ(image.image.pixels, expected.image.pixels);
    EXPECT_EQ(image.reference.pixels, expected.reference.pixels);
    EXPECT_EQ(image.depth_mm.pixels, expected.depth_mm.pixels);
  });
  EXPECT_THAT(names, testing::ElementsAre("train s0/frame_0001", "train s0/frame_0002", "val s1/frame_0001",
                                          "val s1/frame_0002", "train s3/frame_0001", "train s3/frame_0002"));
  names.clear();
  read_packed(shard, {"test"}, true, [&](const DepthImage& image) { names.push_back(image.name); });
  EXPECT_THAT(names, testing::ElementsAre("s2/frame_0002"));
  write_shard(scratch_, {"train"}, NumberType::f16);
  EXPECT_THROW(read_packed(shard, {"train"}, false, [](const DepthImage&) {}), DataError);
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
  std::filesystem::rename(scratch_ / "out/model.pt", scratch_ / "model.pt");
  const std::string judge = shards + fmt::format("--model '{}'", (scratch_ / "model.pt").string());
  ASSERT_EQ(depthnet(judge), 0) << said_;
  const Record judged = Record::from_file(scratch_ / "out/depthnet.yaml").section("summary").section("pressed");
  EXPECT_EQ(judged.required_count("images"), 2);
  // The same by hand.
  const TrainedNetwork network = load_network(scratch_ / "model.pt");
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

TEST(DepthnetConfig, DefaultIsReadAndFaultsAreNamed) {
  const auto config =
      read_config<DepthnetConfig>(std::filesystem::path(TACIPC_SOURCE_DIR) / "configs/depthnet/default.yaml");
  EXPECT_EQ(config.network.levels, 4);
  std::string text = kSmall;
  text.replace(text.find("mae"), 3, "mab");
  text.replace(text.find("epochs: 25"), 10, "epochs: 0");
  text.replace(text.find("levels: 2"), 9, "levels: 9");
  EXPECT_THAT(faults_in<DepthnetConfig>(text, "a.yaml"),
              testing::ElementsAre(testing::HasSubstr("network.levels"), testing::HasSubstr("loss.kind"),
                                   testing::HasSubstr("schedule.epochs")));
}

}  // namespace
}  // namespace tacipc
