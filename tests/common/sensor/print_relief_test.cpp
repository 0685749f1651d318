#include "common/sensor/print_relief.h"

#include <gtest/gtest.h>

#include <numbers>

#include "common/base/units.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace print_relief_test {

Camera camera() {
  return {.position_m = {0, 0, -50e-3},
          .width_px = 41,
          .height_px = 41,
          .window_width_m = 4.1e-3,
          .window_height_m = 4.1e-3};
}

/// A plane at depth 0.5 mm.
MembraneView plane() {
  Sensor sensor;
  sensor.camera = camera();
  return view_height_map(FloatImage(41, 41, 1, 0.5e-3f), sensor);
}

/// Steeper by 0.1 along the object's x over a square of 1 mm about the axis, 2 mm below the origin; unknown elsewhere.
PrintRelief square() {
  PrintRelief relief{.map = FloatImage(41, 41, 3), .pixel_m = 0.1e-3};
  for (int y = 0; y < 41; ++y)
    for (int x = 0; x < 41; ++x) {
      const bool known = std::abs(x - 20) <= 5 && std::abs(y - 20) <= 5;
      relief.map.at(x, y, 0) = known ? -2e-3f : 1.0f;
      relief.map.at(x, y, 1) = known ? 0.1f : 0.0f;
    }
  return relief;
}

TEST(Steeper, AddsSlopes) {
  const Vector3 n = steeper(Vector3(-0.3, -0.2, 1.0).normalized(), 0.1, 0.05);  // slopes 0.3 and 0.2
  EXPECT_NEAR(-n.x() / n.z(), 0.4, 1e-12);
  EXPECT_NEAR(-n.y() / n.z(), 0.25, 1e-12);
}

TEST(ApplyRelief, TurnsNormalsWithTheObjectWhereTheMembraneTouchesIt) {
  MembraneView view = plane();
  // The object's origin is 1.5 mm above the front, so its surface is at the plane; turned by 90°.
  apply_relief(square(), {.x_m = 0.4e-3, .y_m = 0.0, .yaw_rad = 90.0 * kDegree, .origin_z_m = 1.5e-3}, view);
  const Vector3& inside = view.normal[view.index(24, 20)];
  EXPECT_NEAR(-inside.y() / inside.z(), 0.1, 1e-6);
  EXPECT_NEAR(inside.x(), 0.0, 1e-6);
  EXPECT_NEAR(view.normal[view.index(12, 20)].y(), 0.0, 1e-9);  // beside the square
  MembraneView away = plane();
  apply_relief(square(), {.x_m = 0.4e-3, .origin_z_m = 1.52e-3}, away);  // 20 µm above the membrane
  EXPECT_NEAR(away.normal[away.index(24, 20)].x(), 0.0, 1e-9);
}

TEST(PrintReliefFile, ReadsBack) {
  const ScratchFolder scratch;
  const PrintRelief relief = square();
  relief.write(scratch / "r.exr");
  const PrintRelief again = PrintRelief::read(scratch / "r.exr", camera());
  EXPECT_EQ(again.map.pixels, relief.map.pixels);
  EXPECT_NEAR(again.pixel_m, relief.pixel_m, 1e-18);
}

}  // namespace print_relief_test
}  // namespace tacipc
