#include "common/base/printable.h"

#include <gtest/gtest.h>

namespace tacipc {
namespace printable_test {

TEST(Printable, KnowsWhatIsUtf8) {
  for (const char* good : {"", "µm", "d̂ ≥ 5", "\xf0\x9f\x98\x80", "\xf4\x8f\xbf\xbf"})
    EXPECT_TRUE(is_utf8(good)) << good;
  // A byte that continues nothing, half a character, '/' in two bytes and three, a surrogate, beyond the last.
  for (const char* bad :
       {"\x80", "a\xc3", "\xe2\x82", "\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xff"})
    EXPECT_FALSE(is_utf8(bad)) << printable(bad);
}

TEST(Printable, EscapesWhatATerminalWouldObey) {
  EXPECT_EQ(printable("µ \x1b[31mred\x07\r\nnext\x7f"), "µ \\x1b[31mred\\x07\\x0d\nnext\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m \xff"),
            "\\xc2\\x9b31m \\xff");
}

TEST(Printable, QuotesOnOneLineAndCutsBetweenCharacters) {
  EXPECT_EQ(excerpt("a\nb"), "a\\x0ab");
  EXPECT_EQ(excerpt("12345", 5), "12345");
  EXPECT_EQ(excerpt("123µ567", 4), "123… (8 bytes)");
  EXPECT_EQ(excerpt("12\r\r", 6), "12\\x0d… (4 bytes)");
}

}  // namespace printable_test
}  // namespace tacipc
