#include "common/base/checked_file.h"

#include <gtest/gtest.h>

#include <chrono>

#include "common/base/error.h"
#include "common/base/files.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace checked_file_test {

namespace fs = std::filesystem;

TEST(CheckedFile, IsReadBackOnlyIfWhole) {
  const ScratchFolder scratch;
  const fs::path path = scratch / "sub/a";
  EXPECT_EQ(read_checked_file(path), std::nullopt);
  for (const std::string& bytes : {std::string(), std::string("\n\0x", 3), std::string(100000, 'y')}) {
    write_checked_file(path, bytes);
    EXPECT_EQ(read_checked_file(path), bytes);
    const std::string whole = read_file(path);
    write_file(path, whole + "z");
    EXPECT_EQ(read_checked_file(path), std::nullopt);
    std::string flipped = whole;
    flipped.back() = static_cast<char>(flipped.back() ^ 1);
    write_file(path, flipped);
    EXPECT_EQ(read_checked_file(path), std::nullopt);
  }
  write_file(path, "");
  EXPECT_EQ(read_checked_file(path), std::nullopt);
  EXPECT_FALSE(fs::exists(scratch / "sub/a.partial"));
}

TEST(ReplaceIfChanged, KeepsTheTimeOfAFileThatSaysTheSame) {
  const ScratchFolder scratch;
  const fs::path path = scratch / "sub/a";
  EXPECT_TRUE(replace_if_changed(path, "one"));
  const auto long_ago = fs::last_write_time(path) - std::chrono::hours(1);
  fs::last_write_time(path, long_ago);
  EXPECT_FALSE(replace_if_changed(path, "one"));
  EXPECT_EQ(fs::last_write_time(path), long_ago);
  EXPECT_TRUE(replace_if_changed(path, "two"));
  EXPECT_EQ(read_file(path), "two");
  EXPECT_NE(fs::last_write_time(path), long_ago);
  EXPECT_FALSE(fs::exists(scratch / "sub/.a"));
}

TEST(ReplaceIfChanged, SaysWhatItCannotReplace) {
  const ScratchFolder scratch;
  write_file(scratch / "a/b", "");
  EXPECT_THROW(replace_if_changed(scratch / "a", "text"), DataError);
}

}  // namespace checked_file_test
}  // namespace tacipc
