#include "stages/study/tabulate/markdown.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tacipc {
namespace markdown_test {

TEST(Markdown, CellsStayCells) {
  EXPECT_EQ(markdown_cell("a|b\nc"), "a\\|b c");
  EXPECT_EQ(markdown_head({"mesh", "", "n"}), "| mesh | | n |\n|---|---|---|\n");
  EXPECT_EQ(markdown_row({"**both**", "", "1"}), "| **both** | | 1 |\n");
}

TEST(Markdown, NumbersHaveTheirDigits) {
  EXPECT_EQ(markdown_number(-0.1256, 2), "-0.13");
  EXPECT_EQ(markdown_number(INFINITY, 2), "∞");
  EXPECT_EQ(markdown_number(NAN, 2), "–");
  EXPECT_EQ(markdown_deviation(1.0, 0.25, 2), "1.00 ± 0.25");
  EXPECT_EQ(markdown_count(1234567.0), "1,234,567");
  EXPECT_EQ(markdown_count(999.0), "999");
}

TEST(Markdown, ParagraphsAndPictures) {
  EXPECT_EQ(markdown_paragraph("text"), "\ntext\n");
  EXPECT_EQ(markdown_paragraph("text\n"), "\ntext\n");
  EXPECT_EQ(markdown_paragraph(""), "");
  EXPECT_EQ(markdown_picture("x", "", "s.png"), "\n![x](s.png)\n");
  EXPECT_EQ(markdown_picture("x", "pictures", "s.png"), "\n![x](pictures/s.png)\n");
}

}  // namespace markdown_test
}  // namespace tacipc
