// Our straight rendering against POV-Ray's. Needs its program; without it the comparison itself is skipped.
#include <gtest/gtest.h>

#include <algorithm>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/optics/trace.h"
#include "tests/common/optics/test_surfaces.h"
#include "tests/scratch_folder.h"
#include "tests/stages/image/render/third_party/agreement.h"
#include "tests/stages/image/render/third_party/flat_start.h"
#include "tests/stages/image/render/third_party/povray_scene.h"

namespace tacipc {
namespace povray_test {

TEST(Povray, AgreesWithOursOnABallPress) {
  if (!povray_is_there()) GTEST_SKIP() << "there is no program povray";
  const ScratchFolder scratch;
  Sensor sensor = plain_sensor(240, 180);
  sensor.leds = {point_light({5e-3, 0.0, -4e-3})};  // a low ring: shadows
  sensor = comparable_sensor(sensor);
  const Membrane press = height_field(2.4e-3, 1.8e-3, 5e-5, ball_press);
  const TraceResult traced = trace(press, sensor, {.subpixels = 1, .refract = false});
  const FloatImage ours = color_image(traced.basis, sensor);
  const PovrayScene scene = povray_scene(press, sensor);
  run_povray(scratch.file("scene.pov", scene.text), scratch / "out.ppm", sensor.camera, 2);
  FloatImage theirs = read_ppm16(scratch / "out.ppm");
  ASSERT_EQ(theirs.pixels.size(), ours.pixels.size());
  for (float& value : theirs.pixels) value = static_cast<float>(value * scene.white);
  EXPECT_LT(relative_rmse(ours, theirs), 5e-3);
  EXPECT_LT(relative_rmse(flat_start_image(press, sensor), theirs), 5e-4);
  EXPECT_GT(std::count(traced.basis.pixels.begin(), traced.basis.pixels.end(), 0.0f), 1000);  // there are shadows
}

}  // namespace povray_test
}  // namespace tacipc
