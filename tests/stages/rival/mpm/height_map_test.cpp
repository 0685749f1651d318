#include "stages/rival/mpm/height_map.h"

#include <gtest/gtest.h>

namespace tacipc {
namespace height_map_test {

Camera window(double width_m, double height_m) {
  Camera camera;
  camera.position_m = {0.1e-3, 0.0, -12e-3};
  camera.width_px = 41;
  camera.height_px = 31;
  camera.window_width_m = width_m;
  camera.window_height_m = height_m;
  return camera;
}

/// The front of a block of 4 × 3 mm that slopes: 0.02 mm deeper per mm along x, 0.01 mm less per mm along y.
Positions slope(const GelLattice& lattice) {
  Positions front = front_at_rest(lattice);
  front.col(2) = -0.02 * front.col(0) + 0.01 * front.col(1);
  return front;
}

TEST(IndentationMap, PixelsLookWhereTheyAreTold) {
  const GelLattice lattice =
      make_gel_lattice({.counts = std::array{21, 16, 2}, .spacing_m = 0.2e-3, .on_faces = true}, {});
  const Camera camera = window(3e-3, 2e-3);
  const auto expected = [](double x, double y) { return static_cast<float>(0.02 * x - 0.01 * y); };
  const FloatImage ends = indentation_map(lattice, slope(lattice), camera, PixelPlaces::ends);
  EXPECT_NEAR(ends.at(0, 0, 0), expected(-1.4e-3, -1e-3), 1e-9f);
  EXPECT_NEAR(ends.at(40, 30, 0), expected(1.6e-3, 1e-3), 1e-9f);
  EXPECT_NEAR(ends.at(20, 15, 0), expected(0.1e-3, 0.0), 1e-9f);
  EXPECT_NEAR(ends.at(10, 15, 0), expected(-0.65e-3, 0.0), 1e-9f);
  const FloatImage centres = indentation_map(lattice, slope(lattice), camera, PixelPlaces::centres);
  EXPECT_NEAR(centres.at(0, 0, 0), expected(-1.4e-3 + 1.5e-3 / 41, -1e-3 + 1e-3 / 31), 1e-9f);
  EXPECT_NEAR(centres.at(20, 15, 0), expected(0.1e-3, 0.0), 1e-9f);
}

TEST(IndentationMap, BesideTheGelIsZero) {
  const GelLattice lattice =
      make_gel_lattice({.counts = std::array{21, 16, 2}, .spacing_m = 0.2e-3, .on_faces = true}, {});
  Positions front = front_at_rest(lattice);
  front.col(2).array() = -0.5e-3;
  const FloatImage map = indentation_map(lattice, front, window(5e-3, 4e-3), PixelPlaces::centres);
  EXPECT_EQ(map.at(0, 0, 0), 0.0f);
  EXPECT_EQ(map.at(40, 15, 0), 0.0f);
  EXPECT_NEAR(map.at(20, 15, 0), 0.5e-3f, 1e-9f);
  int inside = 0;
  for (const float value : map.pixels) inside += value != 0.0f;
  EXPECT_NEAR(inside, 41 * 31 * 12.0 / 20.0, 60) << "4 x 3 of 5 x 4 mm, without holes";
}

}  // namespace height_map_test
}  // namespace tacipc
