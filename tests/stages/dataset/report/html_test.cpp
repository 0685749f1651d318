#include "stages/dataset/report/html.h"

#include <gtest/gtest.h>

namespace tacipc {
namespace html_test {

TEST(HtmlLink, GoesUpAndDownFromTheFolderOfThePage) {
  EXPECT_EQ(html_link("out/demo/star/render/a.png", "out/demo/report"), "../star/render/a.png");
  EXPECT_EQ(html_link("out/demo/star/press/../../../gels/g.yaml", "out/demo/report/"), "../../gels/g.yaml");
  EXPECT_EQ(html_link("/x/report/a.png", "/x/report"), "a.png");
}

TEST(HtmlLink, EncodesWhatALinkMustNotHold) {
  EXPECT_EQ(html_link("/x/a b#1?%.png", "/x"), "a%20b%231%3F%25.png");
  EXPECT_EQ(html_link("/x/\xc3\xa4\"<.png", "/x"), "%C3%A4%22%3C.png");
  EXPECT_EQ(html_link("/x/javascript:1/a.png", "/x"), "javascript%3A1/a.png");
}

TEST(NumberText, ShowsThreeDigitsInTheRightUnit) {
  EXPECT_EQ(number_text(0.39034), "0.390");
  EXPECT_EQ(number_text(0.45e-3, 1e3), "0.450");
  EXPECT_EQ(number_text(3.787e-5, 1e6), "37.9");
  EXPECT_EQ(number_text(1234.5), "1234");  // ties to even
  EXPECT_EQ(number_text(0.00012), "1.20e-04");
  EXPECT_EQ(number_text(-0.05097), "-0.0510");
  EXPECT_EQ(number_text(-0.0), "0");
  EXPECT_EQ(number_text(std::nullopt), "–");
}

TEST(NumberText, RoundsUpToTheNextPowerWithoutAnExtraDigit) {
  EXPECT_EQ(number_text(0.9996), "1.00");
  EXPECT_EQ(number_text(9.996), "10.0");
}

TEST(CountText, SeparatesThousands) {
  EXPECT_EQ(count_text(7), "7");
  EXPECT_EQ(count_text(999), "999");
  EXPECT_EQ(count_text(23661), "23\u202f661");
  EXPECT_EQ(count_text(1234567), "1\u202f234\u202f567");
  EXPECT_EQ(count_text(std::nullopt), "–");
}

}  // namespace html_test
}  // namespace tacipc
