#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "common/base/error.h"
#include "common/format/hdf5_reader.h"
#include "tests/hdf5_texts.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace hdf5_test {

/// The half that a shard has for a number, and the number that it then stands for.
std::uint16_t half_of(double value) {
  std::uint16_t half = 0;
  std::memcpy(&half, to_bytes(NumberType::f16, {value}).data(), sizeof half);
  return half;
}
double value_of(std::uint16_t half) {
  return from_bytes(NumberType::f16, std::string(reinterpret_cast<const char*>(&half), sizeof half)).front();
}

TEST(Half, ConvertsThereAndBackForAllHalves) {
  for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    const double value = value_of(half);
    if (std::isnan(value)) {
      EXPECT_TRUE(std::isnan(value_of(half_of(value)))) << bits;
      continue;
    }
    EXPECT_EQ(half_of(value), half) << bits;
    // What IEEE 754 says of sign, exponent and mantissa.
    const int exponent = static_cast<int>(bits >> 10 & 0x1f), mantissa = static_cast<int>(bits & 0x3ff);
    const double size = exponent == 0x1f ? std::numeric_limits<double>::infinity()
                        : exponent == 0  ? std::ldexp(mantissa, -24)
                                         : std::ldexp(1024 + mantissa, exponent - 25);
    EXPECT_EQ(value, bits >> 15 != 0 ? -size : size) << bits;
  }
}

TEST(Half, RoundsToTheNearestAndTiesToEvenBetweenAllNeighbours) {
  for (std::uint16_t half = 0; half < 0x7bff; ++half) {
    const auto next = static_cast<std::uint16_t>(half + 1);
    const double low = value_of(half), high = value_of(next), middle = 0.5 * (low + high);
    const std::uint16_t even = half % 2 == 0 ? half : next;
    const auto below = std::nextafter(static_cast<float>(middle), 0.0f);
    const auto above = std::nextafter(static_cast<float>(middle), std::numeric_limits<float>::infinity());
    ASSERT_EQ(half_of(below), half);
    ASSERT_EQ(half_of(middle), even) << half;
    ASSERT_EQ(half_of(above), next);
    ASSERT_EQ(half_of(-middle), even | 0x8000) << half;
  }
}

TEST(Half, EndsInInfinity) {
  EXPECT_EQ(half_of(65519.0), 0x7bff);
  EXPECT_EQ(value_of(0x7bff), 65504.0);
  EXPECT_EQ(half_of(65520.0), 0x7c00);
  EXPECT_EQ(half_of(-std::numeric_limits<double>::infinity()), 0xfc00);
  EXPECT_EQ(half_of(std::numeric_limits<double>::quiet_NaN()), 0x7e00);
}

class Hdf5Test : public ::testing::Test {
 protected:
  /// A file with everything a shard has.
  std::filesystem::path write(const std::string& name) {
    Hdf5Writer file(scratch_ / name);
    file.attribute("/", "text", "grüße");
    file.attribute("/", "whole", Value::List{1, 2, 3});
    file.attribute("/", "number", 0.1);
    file.attribute("/", "matrix", Value::List{Value::List{1.5, 2.0}, Value::List{3.0, 4.0}});
    file.group("/a/b");
    for (const NumberType type : kTypes) {
      const std::string path = std::string("/a/b/") + name_of(type);
      file.dataset(path, type, {2, 40, 30}, true);
      for (std::size_t f = 0; f < 2; ++f) file.write_frame(path, f, to_bytes(type, values(f)));
      file.attribute(path, "unit", "mm");
    }
    file.write("/a/whole", NumberType::f32, {3}, to_bytes(NumberType::f32, {1.0, 2.5, -3.0}));
    file.write_texts("/mask/train", {"one", "second"});
    file.write_texts("/mask/val", {});
    file.close();
    return scratch_ / name;
  }
  static std::vector<double> values(std::size_t frame) {
    std::vector<double> all;
    for (std::size_t i = 0; i < 1200; ++i) all.push_back(static_cast<double>((i * 7 + 31 * frame) % 251));
    return all;
  }
  static constexpr NumberType kTypes[] = {NumberType::u8, NumberType::i32, NumberType::f16, NumberType::f32,
                                          NumberType::f64};
  ScratchFolder scratch_;
};

TEST_F(Hdf5Test, WhatIsWrittenReadsBack) {
  const Hdf5Reader file(write("x.h5"));
  EXPECT_EQ(file.names("/"), (std::vector<std::string>{"a", "mask"}));
  EXPECT_EQ(file.text_attribute("/", "text"), "grüße");
  EXPECT_EQ(to_yaml(file.attributes("/")),
            "matrix:\n  - [1.5, 2]\n  - [3, 4]\nnumber: 0.1\ntext: grüße\nwhole: [1, 2, 3]\n");
  for (const NumberType type : kTypes) {
    const std::string path = std::string("/a/b/") + name_of(type);
    EXPECT_EQ(file.type(path), type);
    EXPECT_EQ(file.shape(path), (std::vector<std::size_t>{2, 40, 30}));
    for (std::size_t f = 0; f < 2; ++f) EXPECT_EQ(from_bytes(type, file.read_frame(path, f)), values(f));
    EXPECT_EQ(file.text_attribute(path, "unit"), "mm");
  }
  EXPECT_EQ(from_bytes(NumberType::f32, file.read("/a/whole")), (std::vector<double>{1.0, 2.5, -3.0}));
  EXPECT_EQ(texts_of(file, "/mask/train"), (std::vector<std::string>{"one", "second"}));
  EXPECT_EQ(texts_of(file, "/mask/val"), std::vector<std::string>{});
  EXPECT_TRUE(file.has("/a/b/uint8"));
  EXPECT_FALSE(file.has("/a/c/uint8"));
}

TEST_F(Hdf5Test, TheSameContentIsTheSameBytes) {
  const auto once = write("x.h5");
  std::vector<char> dirt(1 << 20, 'd');  // what memory held before must not get into the file
  const std::string first = read_file(once);
  EXPECT_EQ(read_file(write("y.h5")), first);
  EXPECT_EQ(dirt.back(), 'd');
}

TEST_F(Hdf5Test, FaultsNameFileAndObject) {
  const auto path = write("x.h5");
  const Hdf5Reader file(path);
  EXPECT_EQ(message_of<DataError>([&] { file.read("/nowhere"); }), path.string() + ": /nowhere: is not a dataset");
  EXPECT_EQ(message_of<DataError>([&] { file.read_frame("/a/b/uint8", 2); }),
            path.string() + ": /a/b/uint8: has no frame 2");
  EXPECT_EQ(message_of<DataError>([&] { file.text_attribute("/", "number"); }),
            path.string() + ": /: attribute number is not a text");
  const auto garbage = scratch_.file("garbage.h5", "this is not an HDF5");
  EXPECT_EQ(message_of<DataError>([&] { Hdf5Reader reader(garbage); }),
            garbage.string() + ": /: is not a readable HDF5 file");
  Hdf5Writer writer(scratch_ / "z.h5");
  writer.dataset("/d", NumberType::f32, {2, 3}, false);
  EXPECT_EQ(message_of<DataError>([&] { writer.write_frame("/d", 0, "four"); }),
            (scratch_ / "z.h5").string() + ": /d: a frame of 4 bytes was given, it takes 12");
  EXPECT_EQ(
      message_of<DataError>([&] {
        writer.attribute("/", "a", Value::List{Value::List{1, 2}, Value::List{3}});
      }),
      (scratch_ / "z.h5").string() + ": /: a: an attribute must be a text, a number, or equally long lists of numbers");
  EXPECT_NE(message_of<DataError>([&] { Hdf5Writer nowhere(scratch_ / "no/such/folder/x.h5"); }), "");
}

}  // namespace hdf5_test
}  // namespace tacipc
