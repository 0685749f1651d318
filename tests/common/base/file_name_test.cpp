#include "common/base/file_name.h"

#include <gtest/gtest.h>

#include "common/base/error.h"

namespace tacipc {

TEST(FileName, LeadsNowhereElse) {
  for (const char* name : {"star", "star__press__000001", "part.v2+b-3", "-x", "0"})
    EXPECT_TRUE(is_file_name(name)) << name;
  for (const char* name : {"", ".", "..", ".hidden", "../star", "/etc", "a/b", "a b", "a\nb", "a;b", "a$b", "Ä"})
    EXPECT_FALSE(is_file_name(name)) << name;
  EXPECT_FALSE(is_file_name(std::string("a\0b", 3)));
  EXPECT_TRUE(is_file_name(std::string(200, 'a')));
  EXPECT_FALSE(is_file_name(std::string(201, 'a')));
}

TEST(FileName, SaysWhereAWrongOneWasFound) {
  EXPECT_EQ(require_file_name("star", "x.h5"), "star");
  try {
    require_file_name("..\x1b", "x.h5: sample 3");
    FAIL();
  } catch (const DataError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("x.h5: sample 3: '..\\x1b': "), std::string::npos) << said;
    EXPECT_NE(said.find(kFileNameRule), std::string::npos) << said;
  }
}

TEST(PlainPath, IsOneWordToMake) {
  for (const char* path : {"star.stl", "../star.stl", "/a/b_c", "."}) EXPECT_TRUE(is_plain_path(path)) << path;
  for (const char* path : {"", "a b", "a$b", "a:b", "a#b", "a\tb", "ä"}) EXPECT_FALSE(is_plain_path(path)) << path;
}

}  // namespace tacipc
