#include "common/optics/seen_membrane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/common/optics/test_surfaces.h"

namespace tacipc {
namespace seen_membrane_test {

Sensor straight() {
  Sensor out;
  out.camera = {
      .position_m = {0, 0, -50e-3}, .width_px = 60, .height_px = 40, .window_width_m = 6e-3, .window_height_m = 4e-3};
  return out;
}

TEST(SeenMembrane, TrianglesAndHeightMapsAgreeOnASlope) {
  // z = −0.4 mm − 0.1 x as two triangles.
  Positions corners(4, 3);
  int row = 0;
  for (const auto& [x, y] : {std::pair{-9e-3, -9e-3}, {9e-3, -9e-3}, {9e-3, 9e-3}, {-9e-3, 9e-3}})
    corners.row(row++) << x, y, -0.4e-3 - 0.1 * x;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  const MembraneView view = view_membrane(corners, triangles, straight());
  const Vector3 normal = Vector3(0.1, 0.0, 1.0).normalized();
  for (const std::size_t i : {view.index(0, 0), view.index(30, 20), view.index(59, 39)}) {
    EXPECT_NEAR(view.point[i].z(), -0.4e-3 - 0.1 * view.point[i].x(), 1e-12);
    EXPECT_NEAR((view.normal[i] - normal).norm(), 0.0, 1e-12);
  }
  FloatImage map(60, 40, 1);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) map.at(x, y, 0) = static_cast<float>(-view.point[view.index(x, y)].z());
  const MembraneView again = view_height_map(map, straight());
  for (const std::size_t i : {view.index(0, 0), view.index(30, 20), view.index(59, 39)}) {
    EXPECT_NEAR((again.point[i] - view.point[i]).norm(), 0.0, 1e-9);
    EXPECT_NEAR((again.normal[i] - normal).norm(), 0.0, 1e-5);
  }
}

TEST(SeenMembrane, WhereNothingIsSeenTheFrontIsFlat) {
  Positions corners(3, 3);
  corners << 0, 0, -1e-3, 1e-3, 0, -1e-3, 0, 1e-3, -1e-3;
  Triangles one(1, 3);
  one << 0, 1, 2;
  const MembraneView view = view_membrane(corners, one, straight());
  EXPECT_EQ(view.point[view.index(0, 0)], view.rest[view.index(0, 0)]);
  EXPECT_EQ(view.normal[view.index(0, 0)], Vector3::UnitZ());
  EXPECT_NEAR(view.point[view.index(33, 23)].z(), -1e-3, 1e-12);
}

}  // namespace seen_membrane_test
}  // namespace tacipc
