#include "stages/object/emboss/stroke_font.h"

#include <gtest/gtest.h>

namespace tacipc {
namespace stroke_font_test {

const std::string kAll = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-.!?";

bool inked(const Strokes& strokes, double x, double y) { return strokes_distance(strokes, 0.16, {x, y}) > 0.0; }

TEST(StrokeFont, NamesWhatItLacks) {
  EXPECT_EQ(missing_characters(kAll + " "), "");
  EXPECT_EQ(missing_characters("TaC?#"), "a#");
}

TEST(StrokeFont, EveryCharacterStaysInItsLineAndDiffersFromTheOthers) {
  std::vector<std::string> drawn;
  for (const char character : kAll) {
    const Strokes strokes = text_strokes(std::string(1, character), 1.0, 0.2);
    ASSERT_FALSE(strokes.empty()) << character;
    std::string picture;
    for (double y = 0.45; y > -0.5; y -= 0.1)
      for (double x = -0.55; x < 0.6; x += 0.1) picture += inked(strokes, x, y) ? '#' : '.';
    for (std::size_t i = 0; i < drawn.size(); ++i) EXPECT_NE(drawn[i], picture) << kAll[i] << " and " << character;
    drawn.push_back(picture);
    for (const Points2& stroke : strokes) {
      for (const Vector2& point : stroke) {
        EXPECT_LE(std::abs(point.y()), 0.5 + 1e-12) << character;
        EXPECT_LE(std::abs(point.x()), 0.55) << character;
      }
    }
  }
}

TEST(StrokeFont, LettersStandUprightAndAreNotMirrored) {
  const Strokes r = text_strokes("R", 1.0, 0.2);  // 0.66 wide, so from −0.33 to 0.33
  EXPECT_TRUE(inked(r, -0.33, 0.0));              // stem on the left
  EXPECT_FALSE(inked(r, 0.33, -0.1));             // nothing right of the waist
  EXPECT_TRUE(inked(r, 0.3, 0.24));               // bowl at the top right
  EXPECT_FALSE(inked(r, 0.0, 0.24));              // which is open
  EXPECT_TRUE(inked(r, 0.31, -0.47));             // leg at the bottom right

  const Strokes l = text_strokes("L", 1.0, 0.2);
  EXPECT_TRUE(inked(l, -0.29, 0.45));
  EXPECT_FALSE(inked(l, 0.2, 0.45));
  EXPECT_TRUE(inked(l, 0.2, -0.5));

  const Strokes seven = text_strokes("7", 1.0, 0.2);
  EXPECT_TRUE(inked(seven, -0.25, 0.5));
  EXPECT_FALSE(inked(seven, 0.25, -0.5));
}

TEST(StrokeFont, TextRunsToTheRightAndIsCentred) {
  const Strokes text = text_strokes("I L", 2.0, 0.5);
  // I at 0, then gap 0.5, space 0.6, gap 0.5, L from 1.6 to 1.6 + 2 · 0.58: 2.76 wide.
  EXPECT_TRUE(inked(text, -1.38, 0.0));
  EXPECT_TRUE(inked(text, 0.22, 0.0));
  EXPECT_TRUE(inked(text, 1.38, -1.0));
  EXPECT_NEAR(strokes_reach(text, 0.4), std::hypot(1.38, 1.0) + 0.2, 1e-12);
}

TEST(StrokesDistance, IsHalfThePenOnTheCentreLine) {
  const Strokes i = text_strokes("I", 1.0, 0.2);
  EXPECT_DOUBLE_EQ(strokes_distance(i, 0.16, {0.0, 0.2}), 0.08);
  EXPECT_DOUBLE_EQ(strokes_distance(i, 0.16, {0.3, 0.9}), 0.08 - 0.5);
  const Strokes dot = text_strokes(".", 1.0, 0.2);
  EXPECT_NEAR(strokes_distance(dot, 0.16, {0.0, -0.6}), 0.08 - 0.1, 1e-15);
}

}  // namespace stroke_font_test
}  // namespace tacipc
