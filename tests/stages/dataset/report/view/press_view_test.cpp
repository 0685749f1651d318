#include "stages/dataset/report/view/press_view.h"

#include <gmock/gmock.h>

namespace tacipc {
namespace {

using ::testing::ElementsAre;

TEST(PressView, PressureIsForceIntoTheFaceOverItsDeformedArea) {
  const Positions x{{0, 0, 0}, {2e-3, 0, 0}, {0, 2e-3, 0}};
  const Positions force{{0, 0, -1}, {3, 0, 0}, {0, 0, 1}};
  const Eigen::VectorXd pressure = vertex_pressures(x, Triangles{{0, 1, 2}}, force);
  EXPECT_NEAR(pressure[0], 1.0 / (2e-6 / 3.0), 1e-6);  // a third of 2 mm²
  EXPECT_EQ(pressure[1], 0.0);                         // along the face
  EXPECT_EQ(pressure[2], 0.0);                         // pulls
}

TEST(PressView, OfManyFramesSomeAreShownFromTheFirstToTheLast) {
  EXPECT_THAT(viewed_frames(1, 1000), ElementsAre(0));
  EXPECT_THAT(viewed_frames(4, 1000), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(viewed_frames(100, 100'000), ElementsAre(0, 33, 66, 99));
  EXPECT_THAT(viewed_frames(9, 1'000'000), ElementsAre(0, 8));
}

}  // namespace
}  // namespace tacipc
