// Networks that were damaged or made to do harm: each is refused, or gives depths that are finite. The same ones every
// time.
#include <gtest/gtest.h>
#include <onnx/onnx_pb.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "common/base/error.h"
#include "stages/image/predict/depth_reader.h"
#include "tests/common/benchmark/onnx_file.h"
#include "tests/common/benchmark/small_depth_model.h"
#include "tests/common/memory_limit.h"
#include "tests/fuzz/mutation.h"

namespace tacipc {
namespace depth_reader_damaged_test {

constexpr int kWidth = 8, kHeight = 6, kFiles = 1000;
constexpr unsigned kMostSeconds = 60;  // of a file; then the alarm ends the test

struct Counts {
  int refused = 0, not_finite = 0, read = 0;
  void record() const {
    ::testing::Test::RecordProperty("refused", refused);
    ::testing::Test::RecordProperty("not_finite", not_finite);
    ::testing::Test::RecordProperty("read", read);
  }
};

/// Reads the file and the depth of an image by it.
void read(const std::string& bytes, int number, Counts& counts) {
  const MemoryLimit limit(std::size_t{1} << 30);
  ::alarm(kMostSeconds);
  ByteImage image(kWidth, kHeight, 3), reference(kWidth, kHeight, 3, 100);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(i * 37 % 256);
  bool accepted = false;
  try {
    const DepthModel model = DepthModel::from_onnx(bytes, "model.onnx");
    accepted = true;
    image = ByteImage(model.columns, model.rows, 3, 90), reference = ByteImage(model.columns, model.rows, 3, 100);
    const FloatImage depth = DepthReader(model, "model.onnx").depth_mm("touch.png", image, reference);
    EXPECT_TRUE(std::ranges::all_of(depth.pixels, [](float value) { return std::isfinite(value); })) << number;
    ++counts.read;
  } catch (const DataError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("model.onnx: ")) << number << error.what();
    EXPECT_LT(std::string(error.what()).size(), 300U) << number;
    ++(accepted ? counts.not_finite : counts.refused);
  } catch (const std::exception& error) {
    ADD_FAILURE() << "file " << number << ": " << typeid(error).name() << ": " << error.what();
  }
  ::alarm(0);
}

TEST(DamagedNetworks, AreRefusedByTheirDigest) {
  const std::string whole = small_depth_model(kWidth, kHeight).to_onnx();
  Mutation mutation({whole, small_depth_model(9, 7).to_onnx()}, 2 * whole.size());
  Counts counts;
  for (int i = 0; i < kFiles; ++i) read(mutation.next(), i, counts);
  counts.record();
  EXPECT_EQ(counts.not_finite, 0);
  // A change may leave a file as it was.
  EXPECT_GT(counts.refused, kFiles - kFiles / 20);
}

TEST(DamagedNetworks, AreRefusedOrAnswerWithNumbersWhereTheDigestIsRight) {
  const std::string whole = small_depth_model(kWidth, kHeight).to_onnx();
  Mutation mutation({whole, small_depth_model(9, 7).to_onnx()}, 2 * whole.size());
  std::mt19937_64 random(2);
  Counts counts;
  for (int i = 0; i < kFiles; ++i) {
    onnx::ModelProto model;
    if (i % 2 == 0) {  // any byte; what is no model any more cannot get a digest
      const std::string bytes = mutation.next();
      read(model.ParseFromString(bytes) ? with_digest(model) : bytes, i, counts);
      continue;
    }
    // Bits of weights: what follows from these alone gets as far as OpenCV.
    model.ParseFromString(whole);
    for (auto changes = 1 + random() % 4; changes > 0; --changes) {
      auto& constants = *model.mutable_graph()->mutable_initializer();
      onnx::TensorProto& constant = constants[static_cast<int>(random() % static_cast<unsigned>(constants.size()))];
      if (!constant.has_raw_data()) continue;
      std::string raw = constant.raw_data();
      raw[random() % raw.size()] ^= static_cast<char>(1U << random() % 8);
      if (random() % 4 == 0) raw[raw.size() - 1] = '\x7f';  // about 1e38
      constant.set_raw_data(raw);
    }
    read(with_digest(model), i, counts);
  }
  counts.record();
  EXPECT_GT(counts.refused, kFiles / 4);
  EXPECT_GT(counts.not_finite, 10);
  EXPECT_GT(counts.read, kFiles / 4);
}

}  // namespace depth_reader_damaged_test
}  // namespace tacipc
