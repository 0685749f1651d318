#include "stages/dataset/report/view/raster.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tacipc {
namespace raster_test {

constexpr Color kRed{200, 0, 0}, kBlue{0, 0, 200};

/// A square across the line of sight, 2 × half wide.
TriangleMesh square(double y, double half) {
  return {Positions{{-half, y, -half}, {half, y, -half}, {half, y, half}, {-half, y, half}},
          Triangles{{0, 1, 2}, {0, 2, 3}}};
}

bool is_white(const ByteImage& image, int x, int y) {
  return image.at(x, y, 0) == 255 && image.at(x, y, 1) == 255 && image.at(x, y, 2) == 255;
}

TEST(Raster, WhatIsNearerHidesWhatIsBehindInWhateverOrder) {
  for (const bool near_first : {false, true}) {
    Raster raster(40, 40, Viewpoint{});
    const auto draw = [&](bool near) {
      raster.draw(square(near ? -0.1 : 0.1, near ? 0.05 : 0.15), Matrix4::Identity(), near ? kRed : kBlue, near);
    };
    draw(near_first);
    draw(!near_first);
    const ByteImage image = raster.picture();
    EXPECT_GT(image.at(20, 20, 0), 100);
    EXPECT_EQ(image.at(20, 20, 2), 0);
    EXPECT_GT(image.at(20, 10, 2), 100);
    EXPECT_TRUE(is_white(image, 0, 0));
  }
}

TEST(Raster, PlacesFollowThePinhole) {
  // Half the picture's height is distance / zoom = 0.2 m at the target.
  Viewpoint from;
  from.zoom = 5.0;
  Raster raster(200, 100, from);
  Matrix4 moved = Matrix4::Identity();
  moved.topRightCorner<3, 1>() << 0.2, 0.0, 0.1;
  raster.draw(square(0.0, 0.05), moved, kRed, 0);
  const ByteImage image = raster.picture();
  // From 0.15 to 0.25 m to the right, 0.05 to 0.15 m up: 250 pixels a metre from (100, 50).
  const auto red = [&](int x, int y) { return !is_white(image, x, y); };
  EXPECT_TRUE(red(138, 25));
  EXPECT_FALSE(red(136, 25));
  EXPECT_TRUE(red(161, 25));
  EXPECT_FALSE(red(163, 25));
  EXPECT_TRUE(red(150, 13));
  EXPECT_FALSE(red(150, 11));
  EXPECT_TRUE(red(150, 36));
  EXPECT_FALSE(red(150, 38));
}

TEST(Raster, WhatReachesBehindTheEyeIsCutOff) {
  Raster raster(40, 40, Viewpoint{});
  // A floor from far in front of the eye, at y = −1, to behind it.
  const TriangleMesh floor{Positions{{-1, 2, -0.1}, {1, 2, -0.1}, {1, -3, -0.1}, {-1, -3, -0.1}},
                           Triangles{{0, 1, 2}, {0, 2, 3}}};
  raster.draw(floor, Matrix4::Identity(), kBlue, 0);
  const ByteImage image = raster.picture();
  EXPECT_GT(image.at(20, 39, 2), 100);
  EXPECT_TRUE(is_white(image, 20, 10));
}

TEST(Raster, LinesRunAlongEdgesButNotAcrossAFace) {
  Viewpoint from;
  from.zoom = 14.0 / 3.0;
  Raster raster(60, 60, from);
  raster.draw(square(0.0, 0.1), Matrix4::Identity(), kRed, 0);
  const ByteImage image = raster.picture();
  const auto red = image.at(30, 30, 0);
  for (int i = 20; i < 40; ++i) EXPECT_EQ(image.at(i, 59 - i, 0), red) << i;  // the diagonal of its two triangles
  EXPECT_EQ(image.at(30, 25, 0), red);
  // Half of 60 pixels is 3 / 14 m: the upper edge lies 14 pixels above the middle.
  EXPECT_LT(image.at(30, 16, 0), red);
}

TEST(Viewpoint, StandsAsNearAsItCanWithAllInThePicture) {
  const std::vector<Vector3> points{{0.1, 0.0, 0.0}, {0.3, 0.2, 0.1}, {0.2, 0.1, 0.4}, {0.15, -0.1, 0.3}};
  for (const double aspect : {0.7, 1.0, 2.0}) {
    const Viewpoint view = viewpoint_of(points, {0.3, -1.0, 0.4}, aspect);
    EXPECT_NEAR(view.right.z(), 0.0, 1e-12);
    EXPECT_NEAR(view.right.cross(view.up).dot(view.back), 1.0, 1e-12);
    double most = 0.0;
    for (const Vector3& p : points) {
      const Vector3 d = p - view.target_m;
      const double scale = view.zoom / (view.distance_m - d.dot(view.back));
      most = std::max({most, scale * std::abs(d.dot(view.up)), scale / aspect * std::abs(d.dot(view.right))});
    }
    EXPECT_LE(most, 1.0);
    EXPECT_GT(most, 0.9);
  }
}

}  // namespace raster_test
}  // namespace tacipc
