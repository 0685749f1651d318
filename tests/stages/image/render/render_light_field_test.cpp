// Rendering with light calibrated on photographs.
#include <gmock/gmock.h>

#include <cmath>

#include "common/image/image.h"
#include "common/optics/seen_membrane.h"
#include "common/sensor/light_field.h"
#include "stages/image/render/pressed_gel.h"
#include "tests/stages/image/render/render_stage.h"

namespace tacipc {
namespace render_light_field_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// kSensor with light calibrated on photographs in place of its LEDs.
std::string calibrated_sensor(const LightField& light) {
  std::string text = kSensor;
  for (const char* key : {"coating:", "leds:", "response:"}) {
    const std::size_t first = text.find(key), after = text.find_first_of("\n", first);
    std::size_t last = after + 1;
    while (last < text.size() && text[last] == ' ') last = text.find('\n', last) + 1;
    text.erase(first, last - first);
  }
  return text + "reference_image: photograph.png\n" + to_yaml(light.to_value());
}

LightField two_lamps() {
  LightField light{.geometry = {.lamps_m = {{6e-3, 1e-3, -3e-3}, {-3e-3, 6e-3, -3e-3}},
                                .shadow_softness = 0.2,
                                .environment_degree = 1,
                                .field_half_width_m = 2e-3},
                   .weights = {},
                   .blur_px = 0.7};
  light.weights.resize(light.geometry.num_features(), 3);
  for (Eigen::Index i = 0; i < light.weights.size(); ++i)
    light.weights.data()[i] = 30.0 * std::sin(1.0 + 3.0 * double(i));
  return light;
}

TEST_F(RenderStage, ALightFieldChangesThePhotographAsItIsCalibratedTo) {
  const ByteImage photograph(32, 24, 3, 130);
  write_png(scratch_ / "photograph.png", photograph);
  write_file(scratch_ / "sensor.yaml", calibrated_sensor(two_lamps()));
  write_file(
      scratch_ / "config.yaml",
      "subpixels: 1\nindirect_rays: 16\nnoise: {seed: 1}\nvariants: [{name: other, reference_image: other.png}]\n");
  write_png(scratch_ / "other.png", ByteImage(32, 24, 3, 100));
  ASSERT_EQ(run(), 0) << said_;
  ASSERT_EQ(run("again", "--threads 3"), 0) << said_;
  EXPECT_EQ(content_hash(scratch_ / "out"), content_hash(scratch_ / "again"));
  EXPECT_EQ(read_png(scratch_ / "out/frame_0000/tactile.png", 3).pixels, photograph.pixels);
  EXPECT_FALSE(fs::exists(scratch_ / "out/frame_0002/linear.exr"));
  // What calibrate and shade see: the same front, moved, one ray a pixel.
  const Sensor sensor = read_config<Sensor>(scratch_ / "sensor.yaml");
  const Membrane front = make_membrane(gel_, PressedGel(scratch_ / "press", gel_).positions(2));
  const FloatImage change = code_change(two_lamps(), view_membrane(front.positions, front.triangles, sensor));
  const ByteImage expected = add_change(photograph, change),
                  seen = read_png(scratch_ / "out/frame_0002/tactile.png", 3);
  const ByteImage other = read_png(scratch_ / "out/frame_0002/other/tactile.png", 3);
  int changed = 0;
  for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
    EXPECT_NEAR(seen.pixels[i], expected.pixels[i], 1) << i;
    EXPECT_NEAR(seen.pixels[i], other.pixels[i] + 30, 1) << i;
    changed += std::abs(seen.pixels[i] - 130) > 5;
  }
  EXPECT_GT(changed, 100);
}

TEST_F(RenderStage, WhatALightFieldCannotDoIsSaid) {
  write_png(scratch_ / "photograph.png", ByteImage(32, 24, 3, 130));
  write_file(scratch_ / "sensor.yaml", calibrated_sensor(two_lamps()));
  write_file(scratch_ / "config.yaml", "transfer: none\nnoise: {seed: 1}\n");
  EXPECT_EQ(run(), 1);
  EXPECT_THAT(said_, HasSubstr("slab: a light_field changes a photograph's codes: transfer must be encoded, "
                               "noise.every_frame false\n"));
  write_file(scratch_ / "config.yaml", "noise: {seed: 1}\nvariants: [{name: v, coating_albedo: [1, 1, 1]}]\n");
  EXPECT_EQ(run(), 1);
  EXPECT_THAT(said_, HasSubstr("variant v: a light_field has neither light groups nor a coating to change\n"));
  write_file(scratch_ / "sensor.yaml", std::string(kSensor) + to_yaml(two_lamps().to_value()));
  EXPECT_EQ(run(), 2);
  for (const char* fault : {"leds: cannot be combined with a light_field, which defines the change of codes",
                            "coating: cannot be combined with", "response: cannot be combined with",
                            "reference_image: missing: a light_field changes its codes"})
    EXPECT_THAT(said_, HasSubstr(fault));
  EXPECT_THAT(said_, testing::Not(HasSubstr("unknown")));
}

}  // namespace render_light_field_test
}  // namespace tacipc
