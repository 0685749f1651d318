#include "common/format/parquet_writer.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/base/error.h"
#include "common/base/files.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace parquet_test {

using namespace std::string_literals;

/// Little-endian.
std::string u32(std::uint32_t value) { return {reinterpret_cast<const char*>(&value), sizeof(value)}; }
std::string i64(std::int64_t value) { return {reinterpret_cast<const char*>(&value), sizeof(value)}; }
std::string f32(float value) { return {reinterpret_cast<const char*>(&value), sizeof(value)}; }

/// A file between its magic words: pages, then the footer.
struct Parts {
  std::string pages, footer;
};
Parts parts_of(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  EXPECT_EQ(bytes.substr(0, 4), "PAR1");
  EXPECT_EQ(bytes.substr(bytes.size() - 4), "PAR1");
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + bytes.size() - 8, sizeof(size));
  return {bytes.substr(4, bytes.size() - 12 - size), bytes.substr(bytes.size() - 8 - size, size)};
}

/// The header of a page of fewer than 64 bytes and values by hand: zigzag doubles a number.
std::string header(int bytes, int values) {
  return "\x15\x00\x15"s + static_cast<char>(2 * bytes) + "\x15"s + static_cast<char>(2 * bytes) +  // type, sizes
         "\x2c\x15"s + static_cast<char>(2 * values) + "\x15\x00\x15\x06\x15\x06\x00\x00"s;         // PLAIN, RLE, RLE
}

TEST(ParquetWriter, WritesFlatColumnsAsTheFormatSays) {
  const ScratchFolder scratch;
  ParquetWriter file(scratch / "a.parquet",
                     {{.name = "n", .type = ParquetType::i64}, {.name = "s", .type = ParquetType::text}}, {{"k", "v"}});
  file.add_row_group({std::vector<std::int64_t>{5, -1}, std::vector<std::string>{"ab", ""}}, 2);
  file.close();
  const Parts parts = parts_of(scratch / "a.parquet");
  EXPECT_EQ(parts.pages, header(16, 2) + i64(5) + i64(-1) + header(10, 2) + u32(2) + "ab" + u32(0));
  const int first = 4, second = 4 + 17 + 16;  // where the pages begin; a header has 17 bytes
  ASSERT_EQ(header(16, 2).size(), 17U);
  const auto column = [](const std::string& offset, const std::string& type, const std::string& name,
                         const std::string& bytes) {
    return "\x26"s + offset + "\x1c\x15"s + type + "\x19\x25\x00\x06\x19\x18\x01"s + name + "\x15\x00\x16\x04\x16"s +
           bytes + "\x16"s + bytes + "\x26"s + offset + "\x00\x00"s;
  };
  EXPECT_EQ(parts.footer,
            "\x15\x02"s                               // version 1
            "\x19\x3c\x48\x06schema\x15\x04\x00"s     // three elements: the root has two children …
            "\x15\x04\x25\x00\x18\x01n\x00"s          // … int64, required, "n" …
            "\x15\x0c\x25\x00\x18\x01s\x25\x00\x00"s  // … bytes, required, "s", UTF8
            "\x16\x04"s                               // two rows
            "\x19\x1c\x19\x2c"s +                     // a row group of two chunks
                column(std::string(1, 2 * first), "\x04", "n", "\x42") +
                column(std::string(1, 2 * second), "\x0c", "s", "\x36") +
                "\x16\x78\x16\x04\x00"s  // 33 + 27 bytes, two rows
                "\x19\x1c\x18\x01k\x18\x01v\x00\x18\x06tacipc\x00"s);
}

TEST(ParquetWriter, WritesDoublesInLists) {
  const ScratchFolder scratch;
  ParquetWriter file(scratch / "a.parquet", {{.name = "d", .type = ParquetType::f64, .shape = {1, 1}}});
  file.add_row_group({std::vector<double>{0.1, -2.5}}, 2);
  file.close();
  const auto f64 = [](double value) { return std::string(reinterpret_cast<const char*>(&value), sizeof(value)); };
  const std::string page = u32(4) + "\x02\x00\x02\x00"s + u32(2) + "\x04\x02"s + f64(0.1) + f64(-2.5);
  const Parts parts = parts_of(scratch / "a.parquet");
  EXPECT_EQ(parts.pages, header(static_cast<int>(page.size()), 2) + page);
  EXPECT_NE(parts.footer.find("\x15\x0a\x25\x00\x18\x07"
                              "element"s),
            std::string::npos)
      << "the type is DOUBLE";
}

TEST(ParquetWriter, WritesListsWithTheirLevels) {
  const ScratchFolder scratch;
  ParquetWriter file(scratch / "a.parquet", {{.name = "m", .type = ParquetType::f32, .shape = {2, 2}}});
  std::vector<float> values{1, 2, 3, 4, 5, 6, 7, 8};
  file.add_row_group({values}, 2);
  file.close();
  // A row begins with level 0, its second list with 1, further values of a list with 2; all are defined at level 2.
  const std::string repetition = "\x02\x00\x02\x02\x02\x01\x02\x02\x02\x00\x02\x02\x02\x01\x02\x02"s;
  std::string page = u32(16) + repetition + u32(2) + "\x10\x02"s;
  for (const float value : values) page += f32(value);
  EXPECT_EQ(parts_of(scratch / "a.parquet").pages, header(static_cast<int>(page.size()), 8) + page);
  // The lists of a schema: group LIST, repeated group, and so on down to the values.
  EXPECT_NE(parts_of(scratch / "a.parquet")
                .footer.find("\x35\x00\x18\x01m\x15\x02\x15\x06\x00\x35\x04\x18\x04list\x15\x02\x00"
                             "\x35\x00\x18\x07"
                             "element\x15\x02\x15\x06\x00\x35\x04\x18\x04list\x15\x02\x00"
                             "\x15\x08\x25\x00\x18\x07"
                             "element\x00"s),
            std::string::npos);
}

TEST(ParquetWriter, JoinsRunsOfEqualLevels) {
  const ScratchFolder scratch;
  ParquetWriter file(scratch / "a.parquet", {{.name = "v", .type = ParquetType::f32, .shape = {300}}});
  file.add_row_group({std::vector<float>(300)}, 1);
  file.close();
  // 0 once, 1 299 times; 1 300 times: counts doubled, seven bits a byte.
  EXPECT_NE(read_file(scratch / "a.parquet").find(u32(5) + "\x02\x00\xd6\x04\x01"s + u32(3) + "\xd8\x04\x01"s),
            std::string::npos);
}

TEST(ParquetWriter, KeepsImagesAsTheyAre) {
  const ScratchFolder scratch;
  ParquetWriter file(scratch / "a.parquet", {{.name = "i", .type = ParquetType::image}});
  file.add_row_group({std::vector<ParquetImage>{{.bytes = "\0\xff"s, .path = "p"}}}, 1);
  file.add_row_group({std::vector<ParquetImage>{{.bytes = "x", .path = "q"}}}, 1);
  EXPECT_EQ(file.rows(), 2U);
  file.close();
  EXPECT_EQ(parts_of(scratch / "a.parquet").pages, header(6, 1) + u32(2) + "\0\xff"s + header(5, 1) + u32(1) + "p" +
                                                       header(5, 1) + u32(1) + "x" + header(5, 1) + u32(1) + "q");
}

TEST(ParquetWriter, SaysWhichFileCannotBeWritten) {
  EXPECT_THROW(ParquetWriter("/dev/full/a.parquet", {}), DataError);
  const ScratchFolder scratch;
  ParquetWriter file("/dev/full", {{.name = "n", .type = ParquetType::i64}});
  try {
    for (int i = 0; i < 1000; ++i) file.add_row_group({std::vector<std::int64_t>(1000)}, 1000);
    file.close();
    FAIL() << "a full disk takes a file";
  } catch (const DataError& error) {
    EXPECT_STREQ(error.what(), "/dev/full: cannot be written");
  }
}

}  // namespace parquet_test
}  // namespace tacipc
