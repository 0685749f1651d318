#include "common/mesh/surface_distance.h"

#include <gtest/gtest.h>

#include "common/sample/placement.h"
#include "tests/make_mesh.h"

namespace tacipc {
namespace surface_distance_test {

TEST(SurfaceDistance, ViewsTurnTheirSideUpAndMirrorNothing) {
  for (const std::string& side : face_names()) {
    const Matrix3 view = view_of_side(side);
    Vector3 out = Vector3::Zero();
    out[side[1] - 'x'] = side[0] == '-' ? -1.0 : 1.0;
    EXPECT_EQ(view * out, Vector3::UnitZ()) << side;
    EXPECT_EQ(view.determinant(), 1.0) << side;
  }
}

TEST(SurfaceDistance, OfWhatIsSeenFromAbove) {
  // A step: half of it is 1 high, half 3.
  TriangleMesh step = make_box({0, 0, 0}, {2, 2, 1});
  const TriangleMesh high = make_box({2, 0, 0}, {4, 2, 3});
  step.positions.conservativeResize(16, 3);
  step.positions.bottomRows(8) = high.positions;
  step.triangles.conservativeResize(24, 3);
  step.triangles.bottomRows(12) = high.triangles.array() + 8;
  const std::vector<Vector3> seen = seen_points(step, 0.1);
  for (const Vector3& point : seen) EXPECT_NEAR(point.z(), point.x() < 2.0 - 1e-6 ? 1.0 : 3.0, 1e-12) << point;
  const TriangleMesh lid = make_box({-9, -9, 4}, {9, 9, 5});
  const SurfaceDistance distance = distance_from(lid, seen);
  EXPECT_NEAR(distance.max_m, 3.0, 1e-12);
  EXPECT_NEAR(distance.mean_m, 2.0, 0.06);
}

TEST(SurfaceDistance, NothingIsSeenBelowASteepFace) {
  // Its plane falls 170 m in the half micrometre beside it that counts as inside.
  const TriangleMesh steep = make_mesh({{0, 0, 0}, {0, 1e-5, 0}, {3e-14, 0, 1e-5}}, {{0, 1, 2}});
  const std::vector<Vector3> seen = seen_points(steep, 5e-7);
  EXPECT_GT(seen.size(), 40u);
  for (const Vector3& point : seen) {
    EXPECT_GE(point.z(), 0.0);
    EXPECT_LE(point.z(), 1e-5);
  }
}

}  // namespace surface_distance_test
}  // namespace tacipc
