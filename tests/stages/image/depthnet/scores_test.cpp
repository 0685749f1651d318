#include "stages/image/depthnet/scores.h"

#include <gtest/gtest.h>

namespace tacipc {
namespace scores_test {

TEST(Scores, AreThoseByHand) {
  const std::vector<double> said{0.9, 0.6, 0.4, 0.4, 0.1};
  const std::vector<bool> truth{true, false, true, false, false};
  const Scores scores = scores_of(said, truth);
  EXPECT_NEAR(scores.accuracy, 3.0 / 5, 1e-12);
  EXPECT_NEAR(scores.balanced_accuracy, 0.5 * (1.0 / 2 + 2.0 / 3), 1e-12);
  // 0.9 beats all three of the no; 0.4 beats 0.1, equals 0.4 and loses to 0.6.
  EXPECT_NEAR(scores.auc, (3 + 1.5) / 6, 1e-12);
  EXPECT_NEAR(scores_of({0.7, 0.7, 0.7, 0.7, 0.7}, truth).auc, 0.5, 1e-12);
}

TEST(Roc, IsHighestAtItsSteps) {
  const auto roc = roc_of({0.9, 0.6, 0.4, 0.4, 0.1}, {true, false, true, false, false});
  const std::vector<std::pair<double, double>> expected{
      {0.0, 0.0}, {0.0, 0.5}, {1.0 / 3, 0.5}, {2.0 / 3, 1.0}, {1.0, 1.0}};
  ASSERT_EQ(roc.size(), expected.size());
  for (std::size_t i = 0; i < roc.size(); ++i) {
    EXPECT_NEAR(roc[i].first, expected[i].first, 1e-12);
    EXPECT_NEAR(roc[i].second, expected[i].second, 1e-12);
  }
  EXPECT_NEAR(height_of(roc, 0.0), 0.5, 1e-12);
  EXPECT_NEAR(height_of(roc, 0.5), 0.75, 1e-12);
  EXPECT_NEAR(height_of(roc, 1.0), 1.0, 1e-12);
}

}  // namespace scores_test
}  // namespace tacipc
