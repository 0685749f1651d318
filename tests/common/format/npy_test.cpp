#include "common/format/npy.h"

#include "common/base/error.h"
#include "tests/common/sample_files.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace npy_test {

template <typename T>
std::string packed(std::vector<T> values, std::endian order = std::endian::little) {
  Bytes bytes;
  bytes.order = order;
  for (const T value : values) bytes.add(value);
  return bytes.text;
}

TEST(Npy, ComesBackBitByBitAndAligned) {
  const ScratchFolder scratch;
  const std::vector<std::vector<std::size_t>> shapes{{}, {6}, {2, 3}, {3, 1, 2}, {0, 3}, {2, 3, 0}};
  const std::vector<double> data{0.1, -0.0, 1e-310, 4, 5, 1e300};
  for (const auto& shape : shapes) {
    write_npy(scratch / "a.npy", shape, data.data());
    const NpyArray back = read_npy(scratch / "a.npy");
    EXPECT_EQ(back.shape, shape);
    std::size_t count = 1;
    for (const std::size_t extent : shape) count *= extent;
    ASSERT_EQ(back.data.size(), count);
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(back.data[i]), std::bit_cast<std::uint64_t>(data[i]));
    EXPECT_EQ((read_file(scratch / "a.npy").size() - 8 * count) % 64, 0u);
  }
}

TEST(Npy, WritesIntegersAndBytesUnderTheirOwnType) {
  const ScratchFolder scratch;
  const std::vector<std::int32_t> numbers{0, -1, 2147483647, -2147483648, 7, 8};
  write_npy(scratch / "i.npy", {3, 2}, numbers.data());
  const NpyArray integers = read_npy(scratch / "i.npy");
  EXPECT_EQ(integers.shape, (std::vector<std::size_t>{3, 2}));
  EXPECT_EQ(integers.data, std::vector<double>(numbers.begin(), numbers.end()));
  const std::string integer_bytes = read_file(scratch / "i.npy");
  EXPECT_NE(integer_bytes.find("{'descr': '<i4', 'fortran_order': False, 'shape': (3, 2), }"), std::string::npos);
  EXPECT_EQ((integer_bytes.size() - 4 * numbers.size()) % 64, 0u);

  const std::vector<std::uint8_t> states{0, 1, 2, 255};
  write_npy(scratch / "u.npy", {4}, states.data());
  const NpyArray bytes = read_npy(scratch / "u.npy");
  EXPECT_EQ(bytes.shape, (std::vector<std::size_t>{4}));
  EXPECT_EQ(bytes.data, (std::vector<double>{0, 1, 2, 255}));
  EXPECT_NE(read_file(scratch / "u.npy").find("{'descr': '|u1', 'fortran_order': False, 'shape': (4,), }"),
            std::string::npos);
}

TEST(Npy, ReadsTheTypesAndOrdersThatOthersWrite) {
  const ScratchFolder scratch;
  const std::vector<double> wanted{1, 2, 3, 4, 5, 6};
  const std::string c = "'fortran_order': False, 'shape': (2, 3), ";
  const std::vector<std::string> files{
      npy_bytes("<f8", c, packed<double>({1, 2, 3, 4, 5, 6})),
      npy_bytes(">f8", c, packed<double>({1, 2, 3, 4, 5, 6}, std::endian::big)),
      npy_bytes("<f4", c, packed<float>({1, 2, 3, 4, 5, 6})),
      npy_bytes("<i8", c, packed<std::int64_t>({1, 2, 3, 4, 5, 6})),
      npy_bytes(">i4", c, packed<std::int32_t>({1, 2, 3, 4, 5, 6}, std::endian::big)),
      npy_bytes("|u1", c, packed<std::uint8_t>({1, 2, 3, 4, 5, 6})),
      npy_bytes("<f8", "'fortran_order': True, 'shape': (2, 3), ", packed<double>({1, 4, 2, 5, 3, 6}))};
  for (const std::string& bytes : files) {
    const NpyArray array = read_npy(scratch.file("a.npy", bytes));
    EXPECT_EQ(array.data, wanted);
    EXPECT_EQ(array.shape, (std::vector<std::size_t>{2, 3}));
  }
}

TEST(Npy, RefusesWhatDoesNotFit) {
  const ScratchFolder scratch;
  const std::string name = (scratch / "a.npy").string();
  const auto error = [&](const std::string& bytes) {
    return message_of<DataError>([&] { read_npy(scratch.file("a.npy", bytes)); });
  };
  const std::string c = "'fortran_order': False, 'shape': (2, 3), ";
  EXPECT_EQ(error("PK"), name + ": is not an NPY file");
  EXPECT_EQ(error(npy_bytes("<f8", c, "12345678")),
            name + ": shape (2, 3) of <f8 takes 48 bytes, the file has 8 after its header");
  EXPECT_EQ(error(npy_bytes("<f8", "'fortran_order': False, 'shape': (4000000000, 4000000000, 8), ", "")),
            name + ": shape (4000000000, 4000000000, 8) of <f8 takes too many bytes, the file has 0 after its header");
  EXPECT_EQ(error(npy_bytes("<c16", c, "")), name + ": NPY type '<c16' is not supported (f8, f4, i8, i4 and u1 are)");
  EXPECT_EQ(error(npy_bytes("<f8", "'fortran_order': False, 'shape': (2, x), ", "")).substr(0, name.size() + 35),
            name + ": the NPY shape '(2, x), }         ");
  EXPECT_EQ(error(npy_bytes("<f8", "'shape': (2,), ", "")), name + ": the NPY header has no 'fortran_order'");
  const double one = 1.0;
  write_npy(scratch / "a.npy", {1, 1}, &one);
  EXPECT_EQ(read_npy(scratch / "a.npy", {1, 1}).data, std::vector<double>{1.0});
  EXPECT_EQ(message_of<DataError>([&] {
              read_npy(scratch / "a.npy", {1, 2});
            }),
            name + ": has the shape (1, 1), expected (1, 2)");
  EXPECT_EQ(message_of<DataError>([&] { write_npy("/dev/full", {1}, &one); }),
            "/dev/full: cannot be written: No space left on device");
}

TEST(Npy, FramesAreReadOneByOne) {
  const ScratchFolder scratch;
  const std::vector<double> values{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  write_npy(scratch / "a.npy", {3, 2, 2}, values.data());
  NpyFrames frames(scratch / "a.npy");
  EXPECT_EQ(frames.shape(), (std::vector<std::size_t>{3, 2, 2}));
  EXPECT_EQ(frames.frame_shape(), (std::vector<std::size_t>{2, 2}));
  EXPECT_EQ(frames.frame(2), (std::vector<double>{9, 10, 11, 12}));
  EXPECT_EQ(frames.frame(0), (std::vector<double>{1, 2, 3, 4}));
  const std::vector<std::uint8_t> codes{7, 8};
  write_npy(scratch / "b.npy", {2}, codes.data());
  EXPECT_EQ(NpyFrames(scratch / "b.npy").frame(1), std::vector<double>{8});
}

TEST(Npy, FramesRefuseWhatHasNone) {
  const ScratchFolder scratch;
  const std::string name = (scratch / "a.npy").string();
  const double one = 1.0;
  write_npy(scratch / "a.npy", {}, &one);
  EXPECT_EQ(message_of<DataError>([&] { NpyFrames frames(name); }),
            name + ": cannot be read by its first axis: it has none");
  scratch.file("a.npy", npy_bytes("<f8", "'fortran_order': True, 'shape': (1, 1), ", std::string(8, '\0')));
  EXPECT_EQ(message_of<DataError>([&] { NpyFrames frames(name); }),
            name + ": cannot be read by its first axis: it is in Fortran order");
  EXPECT_EQ(message_of<DataError>([&] { NpyFrames frames(scratch / "none.npy"); }),
            (scratch / "none.npy").string() + ": cannot be read");
  const std::vector<double> two{1.0, 2.0};
  write_npy(name, {2}, two.data());
  NpyFrames cut(name);
  std::filesystem::resize_file(name, std::filesystem::file_size(name) - 8);
  EXPECT_EQ(message_of<DataError>([&] { cut.frame(1); }), name + ": ends inside frame 1");
}

}  // namespace npy_test
}  // namespace tacipc
