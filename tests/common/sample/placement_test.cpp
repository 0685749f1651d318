#include "common/sample/placement.h"

#include <gtest/gtest.h>

#include <numbers>

#include "common/base/error.h"

namespace tacipc {
namespace placement_test {

const Positions kBox{{1, 2, 3}, {2, 4, 6}};

TEST(Place, EveryFaceTurnsDownByAProperRotation) {
  for (const std::string& face : face_names()) {
    const Matrix4 pose = place(kBox, {.face = face}, 0.5);
    const Matrix3 rotation = pose.topLeftCorner<3, 3>();
    EXPECT_EQ(rotation.determinant(), 1.0) << face;
    Vector3 normal = Vector3::Zero();
    normal[face[1] - 'x'] = face[0] == '+' ? 1.0 : -1.0;
    EXPECT_EQ((rotation * normal).eval(), Vector3(0, 0, -1)) << face;
    const Positions placed = transformed(pose, kBox);
    EXPECT_DOUBLE_EQ(placed.col(2).minCoeff(), 0.5) << face;
    EXPECT_DOUBLE_EQ(placed.col(0).sum(), 0.0) << face;  // box centred
    EXPECT_DOUBLE_EQ(placed.col(1).sum(), 0.0) << face;
  }
  EXPECT_THROW(place(kBox, {.face = "up"}, 0.0), UsageError);
}

TEST(Place, TurnsFromXTowardsYAndShifts) {
  const Matrix4 pose =
      place(kBox, {.face = "-z", .rotate_rad = std::numbers::pi / 2, .center_x_m = 10, .center_y_m = 20}, 0.0);
  EXPECT_LT((pose.topLeftCorner<3, 3>() * Vector3::UnitX() - Vector3::UnitY()).norm(), 1e-15);
  const Positions placed = transformed(pose, kBox);
  EXPECT_NEAR(0.5 * placed.col(0).sum(), 10.0, 1e-14);
  EXPECT_NEAR(0.5 * placed.col(1).sum(), 20.0, 1e-14);
}

TEST(OppositeFace, IsTheOtherSide) {
  EXPECT_EQ(opposite_face("+z"), "-z");
  EXPECT_EQ(opposite_face("-x"), "+x");
}

}  // namespace placement_test
}  // namespace tacipc
