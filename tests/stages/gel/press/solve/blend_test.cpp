// How much of the PSD approximation a step takes.
#include <gtest/gtest.h>

#include "stages/gel/press/solve/blend.h"

namespace tacipc {
namespace blend_test {

TEST(Blend, TakesAsLittleOfThePsdApproximationAsTheMatrixAllows) {
  Blend blend(3);
  EXPECT_EQ(blend.largest(), 1.0);
  double last = 1.0;
  for (int i = 0; i < 3 && last > 0.0; ++i, last = blend.share(1)) {
    blend.lower();
    EXPECT_LT(blend.largest(), last / 3);
  }
  EXPECT_EQ(blend.largest(), 0.0);
  // Indefinite about one vertex: its share, and no other, rises to 1.
  for (last = 0.0; blend.raise(1); last = blend.share(1)) EXPECT_GT(blend.share(1), last);
  EXPECT_EQ(blend.share(1), 1.0);
  EXPECT_EQ(blend.share(0) + blend.share(2), 0.0);
  EXPECT_EQ(blend.share(std::vector<int>{0, 1, 7}), 1.0);
  EXPECT_EQ(blend.share(std::vector<int>{0, 2, 7}), 0.0);
  // And falls more slowly the more often it had to rise.
  for (int i = 0; i < 10; ++i) {
    blend.lower();
    blend.raise(1);
  }
  while (blend.raise(1)) {
  }
  blend.lower();
  EXPECT_GT(blend.share(1), 0.5);
}

/// A shortened step was found with shares that have been lowered since: the next is to have more than it had, there and
/// nowhere else, and all of the approximation if that does not help.
TEST(Blend, RisesAfterAShortenedStepAboveWhatItWasFoundWith) {
  Blend blend({0.0, 0.15, 0.0, 0.9});
  blend.lower();
  const double lowered[] = {blend.share(0), blend.share(1), blend.share(2), blend.share(3)};
  EXPECT_LT(lowered[1], 0.15);
  for (const int v : {0, 1, 3}) blend.raise_after_shortening(v);
  EXPECT_GT(blend.share(0), 0.0);
  EXPECT_GT(blend.share(1), 2 * 0.15);
  EXPECT_EQ(blend.share(2), lowered[2]);
  EXPECT_EQ(blend.share(3), 1.0);
  // Shortened again and again.
  int steps = 0;
  for (; blend.share(0) < 1.0 && steps < 10; ++steps) {
    blend.lower();
    blend.raise_after_shortening(0);
  }
  EXPECT_EQ(blend.share(0), 1.0);
  EXPECT_LE(steps, 4);
  // And down to the exact Hessian again where no step is shortened any more.
  for (steps = 0; blend.largest() > 0.0 && steps < 10; ++steps) blend.lower();
  EXPECT_EQ(blend.largest(), 0.0);
}

/// A patch lowers shares on its own; what it found holds for the whole gel.
TEST(Blend, TakesOverAboutOneVertexWhatAnotherHasFound) {
  Blend blend(3), patch = blend;
  while (patch.largest() > 0.0) patch.lower();
  patch.lower();
  patch.raise(2);
  EXPECT_TRUE(blend.approximated(1));
  blend.take_over(1, patch);
  blend.take_over(2, patch);
  EXPECT_EQ(blend.share(0), 1.0);
  EXPECT_EQ(blend.share(1), 0.0);
  EXPECT_EQ(blend.share(2), patch.share(2));
  EXPECT_TRUE(blend.approximated(0));
  EXPECT_FALSE(blend.approximated(1));
  blend.lower();
  patch.lower();
  EXPECT_EQ(blend.share(2), patch.share(2));
  EXPECT_TRUE(blend.approximated(2));
}

TEST(Blend, StaysWithThePsdApproximationUnlessAdaptive) {
  Blend blend(2, false);
  for (int i = 0; i < 5; ++i) blend.lower();
  blend.raise_after_shortening(0);
  EXPECT_EQ(blend.share(0), 1.0);
  EXPECT_EQ(blend.share(1), 1.0);
}

}  // namespace blend_test
}  // namespace tacipc
