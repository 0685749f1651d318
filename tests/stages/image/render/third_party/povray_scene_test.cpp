// Scene, picture and figures of the comparison with POV-Ray, without its program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/optics/trace.h"
#include "tests/common/optics/test_surfaces.h"
#include "tests/scratch_folder.h"
#include "tests/stages/image/render/third_party/agreement.h"
#include "tests/stages/image/render/third_party/flat_start.h"
#include "tests/stages/image/render/third_party/povray_scene.h"

namespace tacipc {
namespace povray_scene_test {

using ::testing::HasSubstr;

TEST(PovrayScene, SaysByHandWhatIsInIt) {
  Positions square(4, 3);
  square << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  Triangles two(2, 3);
  two << 0, 1, 2, 0, 2, 3;
  const Membrane membrane = make_membrane(kMm * square, kMm * square, two);
  Sensor sensor = plain_sensor(8, 6);
  sensor.leds = {point_light({1e-3, -1e-3, -10e-3})};  // 10 mm above a corner
  const PovrayScene scene = povray_scene(membrane, sensor);
  EXPECT_NEAR(scene.white, 1.01 * 1e4 / std::numbers::pi, 1e-6);
  EXPECT_THAT(scene.text, HasSubstr("camera { perspective location <0,0,-120> direction <0,0,120> right <40,0,0> up "
                                    "<0,-30,0> }\n"));
  // 1 / (2 (1e-5 m)² · 10100 / m²)
  EXPECT_THAT(scene.text, HasSubstr("light_source { <10,-10,-100> color rgb <495049.505,495049.505,495049.505> "
                                    "fade_distance 0.1 fade_power 2 }\n"));
  EXPECT_THAT(scene.text, HasSubstr("vertex_vectors { 4,\n<-10,-10,0>,\n<10,-10,0>,\n<10,10,0>,\n<-10,10,0> }\n"));
  EXPECT_THAT(scene.text, HasSubstr("normal_vectors { 4,\n<-0,-0,-1>"));
  EXPECT_THAT(scene.text, HasSubstr("face_indices { 2,\n<0,1,2>,\n<0,2,3> }\n"));
}

TEST(PovrayScene, NothingIsBrighterThanItsWhite) {
  Sensor sensor = plain_sensor(64, 48);
  sensor.leds = {point_light({5e-3, 0.0, -4e-3})};
  sensor = comparable_sensor(sensor);
  const Membrane press = height_field(2.4e-3, 1.8e-3, 1e-4, ball_press);
  const FloatImage ours = color_image(trace(press, sensor, {.refract = false}).basis, sensor);
  const float most = *std::max_element(ours.pixels.begin(), ours.pixels.end());
  const double white = povray_scene(press, sensor).white;
  EXPECT_LT(most, white);
  EXPECT_GT(most, 0.2 * white);  // and 16 bits are not wasted
}

TEST(FlatStart, IsOurPictureButForTrianglesThatHideTheirNeighbours) {
  Sensor sensor = plain_sensor(64, 48);
  sensor.leds = {point_light({5e-3, 0.0, -4e-3})};
  sensor = comparable_sensor(sensor);
  const auto both = [&](const Membrane& membrane) {
    const TraceResult traced = trace(membrane, sensor, {.subpixels = 1, .refract = false});
    return std::array{color_image(traced.basis, sensor), flat_start_image(membrane, sensor)};
  };
  const auto plane = both(height_field(2.4e-3, 1.8e-3, 1e-4, [](double, double) { return 0.0; }));
  EXPECT_LT(relative_rmse(plane[0], plane[1]), 1e-6);
  const auto ball = both(height_field(2.4e-3, 1.8e-3, 1e-4, ball_press));
  int darker = 0;
  for (std::size_t i = 0; i < ball[0].pixels.size(); ++i) {
    EXPECT_LE(ball[1].pixels[i], ball[0].pixels[i] * (1.0f + 1e-5f)) << i;
    darker += ball[1].pixels[i] < 0.99f * ball[0].pixels[i];
  }
  EXPECT_GT(darker, 10);
  EXPECT_LT(darker, 400);
}

TEST(ReadPpm16, TakesBigEndianValuesAfterComments) {
  const ScratchFolder scratch;
  const std::string values("\xff\xff\x00\x00\x80\x00\x00\x01\x00\x02\x01\x00", 12);
  const FloatImage image = read_ppm16(scratch.file("a.ppm", "P6\n# by hand\n2 1\n65535\n" + values));
  ASSERT_EQ(image.width, 2);
  ASSERT_EQ(image.height, 1);
  const double expected[6] = {65535, 0, 32768, 1, 2, 256};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_FLOAT_EQ(image.pixels[i], static_cast<float>(expected[i] / 65535)) << i;
  const auto short_file = scratch.file("b.ppm", "P6\n2 1\n65535\n" + values.substr(0, 11));
  EXPECT_THAT(message_of<DataError>([&] { read_ppm16(short_file); }), HasSubstr("the file ends inside the pixels"));
  const auto bytes = scratch.file("c.ppm", "P6\n2 1\n255\n" + values);
  EXPECT_THAT(message_of<DataError>([&] { read_ppm16(bytes); }), HasSubstr("c.ppm: is not a PPM of 16 bits"));
  const auto empty = scratch.file("d.ppm", "P6\n0 1\n65535\n" + values);
  EXPECT_THAT(message_of<DataError>([&] { read_ppm16(empty); }), HasSubstr("d.ppm: is 0 x 1 pixels"));
}

TEST(RelativeRmse, IsTheOneByHand) {
  FloatImage ours(4, 2, 3), theirs(4, 2, 3);
  ours.at(0, 0, 1) = 4.0f;
  ours.at(3, 1, 2) = 3.0f;
  theirs = ours;
  EXPECT_EQ(relative_rmse(ours, theirs), 0.0);
  theirs.at(0, 0, 1) = 4.5f;
  theirs.at(1, 0, 0) = 1.0f;
  EXPECT_NEAR(relative_rmse(ours, theirs), std::sqrt(1.25) / 5.0, 1e-12);
  EXPECT_FLOAT_EQ(halved(theirs).at(0, 0, 1), 1.125f);
  EXPECT_FLOAT_EQ(halved(theirs).at(1, 0, 2), 0.75f);
}

}  // namespace povray_scene_test
}  // namespace tacipc
