#include "common/mesh/zip_parts.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "tests/common/sample_files.h"
#include "tests/common/zip_file.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace zip_parts_test {

/// An archive whose list says that its one file unpacks to this many bytes; it has ten.
std::string archive_of_large_file(std::uint32_t says) {
  Bytes zip;
  const auto file = [&](std::uint32_t signature, bool in_list) {
    zip.add(signature);
    if (in_list) zip.add(std::uint16_t{20});
    zip.add(std::uint16_t{20}).add(std::uint16_t{0}).add(std::uint16_t{8}).add(std::uint32_t{0}).add(std::uint32_t{0});
    zip.add(std::uint32_t{10}).add(says).add(std::uint16_t{1}).add(std::uint16_t{0});
    if (in_list)
      zip.add(std::uint16_t{0}).add(std::uint16_t{0}).add(std::uint16_t{0}).add(std::uint32_t{0}).add(std::uint32_t{0});
    zip.raw("a");
  };
  file(0x04034b50, false);
  zip.raw("0123456789");
  const auto list = static_cast<std::uint32_t>(zip.text.size());
  file(0x02014b50, true);
  const auto size = static_cast<std::uint32_t>(zip.text.size()) - list;
  zip.add(std::uint32_t{0x06054b50})
      .add(std::uint32_t{0})
      .add(std::uint16_t{1})
      .add(std::uint16_t{1})
      .add(size)
      .add(list)
      .add(std::uint16_t{0});
  return zip.text;
}

TEST(ZipParts, AreReadInTheOrderAskedFor) {
  const std::string zip =
      zip_of({{"a.txt", "one"}, {"b/C d.txt", "two"}, {"e", ""}, {"f", std::string(5'000'000, 'f')}});
  ZipParts parts(zip, "a.zip");
  EXPECT_EQ(parts.read({"/f", "b/C d.txt", "/e", "/a.txt"}),
            (std::vector<std::string>{std::string(5'000'000, 'f'), "two", "", "one"}));
  EXPECT_EQ(parts.read({"/B/c%20D.txt", "b/C d.txt"}), (std::vector<std::string>{"two", "two"}));
  EXPECT_TRUE(parts.has("./A.TXT"));
  EXPECT_FALSE(parts.has("b"));
  EXPECT_EQ(message_of<DataError>([&] { parts.read({"/g"}); }), "a.zip: has no part /g");
}

TEST(ZipParts, ThatNoOneAsksForAreNotUnpacked) {
  std::string zip = zip_of({{"good", "content"}, {"bad", "content"}}, ZipMethod::store);
  zip[zip.find("content", zip.find("bad"))] = 'C';
  ZipParts parts(zip, "a.zip");
  EXPECT_EQ(parts.read({"good"}).front(), "content");
  EXPECT_THAT(message_of<DataError>([&] { parts.read({"bad"}); }),
              ::testing::StartsWith("a.zip: bad cannot be unpacked ("));
}

TEST(ZipParts, OfOneNameAreRefused) {
  for (const char* other : {"a", "A", "/a"}) {
    const std::string zip = zip_of({{"a", "one"}, {other, "two"}, {"b", "three"}});
    ZipParts parts(zip, "a.zip");
    EXPECT_EQ(message_of<DataError>([&] { parts.read({"a"}); }), "a.zip: has the part a twice") << other;
    EXPECT_EQ(parts.read({"b"}).front(), "three");
  }
}

TEST(ZipParts, HaveALimitTogether) {
  const std::string zip = zip_of({{"a", std::string(3'000'000, 'a')}, {"b", std::string(3'000'000, 'b')}});
  EXPECT_EQ(ZipParts(zip, "a.zip", 6'000'000).read({"a", "b"}).size(), 2u);
  EXPECT_EQ(message_of<DataError>([&] {
              ZipParts(zip, "a.zip", 5 << 20).read({"a", "b"});
            }),
            "a.zip: with b it unpacks to more than 5 MiB");
  ZipParts parts(zip, "a.zip", 5 << 20);
  parts.read({"a"});
  EXPECT_EQ(message_of<DataError>([&] { parts.read({"b"}); }), "a.zip: with b it unpacks to more than 5 MiB");
  for (const std::uint32_t says : {(1u << 30) + 1, 3'000'000'000u, 4'294'967'294u}) {
    const std::string large = archive_of_large_file(says);
    EXPECT_EQ(message_of<DataError>([&] { ZipParts(large, "a.zip").read({"a"}); }),
              "a.zip: with a it unpacks to more than 1024 MiB");
  }
}

}  // namespace zip_parts_test
}  // namespace tacipc
