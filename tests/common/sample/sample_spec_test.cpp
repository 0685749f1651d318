#include "common/sample/sample_spec.h"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/config_text.h"

namespace tacipc {
namespace sample_spec_test {

using ::testing::ElementsAre;

TEST(SampleSpec, ReadsPlacementAndMotionInSi) {
  const auto sample = config_from_text<SampleSpec>(
      "placement: {face: +x, rotate_deg: 90, center_mm: [1, -2]}\nmotion: {kind: press, depth_mm: 0.5, steps: 5}\n",
      "x.yaml");
  EXPECT_EQ(sample.face, "+x");
  EXPECT_DOUBLE_EQ(sample.rotate_rad, std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(sample.center_y_m, -0.002);
  ASSERT_EQ(sample.motion.size(), 1u);
  EXPECT_EQ(sample.motion[0].kind, PhaseKind::press);
  EXPECT_DOUBLE_EQ(sample.motion[0].depth_m, 0.0005);
  EXPECT_EQ(sample.motion[0].steps, 5);
  EXPECT_FALSE(sample.may_miss);
  EXPECT_TRUE(
      config_from_text<SampleSpec>("placement: {may_miss: true}\nmotion: {kind: hold, steps: 1}\n", "x.yaml").may_miss);
}

TEST(SampleSpec, NamesWhatIsWrong) {
  EXPECT_THAT(
      faults_in<SampleSpec>("placement: {face: z}\nmotion: {kind: push, depth_mm: 0, steps: 0}\n", "x.yaml"),
      ElementsAre("x.yaml:1:19: placement.face: 'z' is not one of +x, -x, +y, -y, +z, -z (did you mean +z?)",
                  "x.yaml:2:16: motion.kind: 'push' is not one of press, shear, twist, hold, release, tilt, path, "
                  "load, free (did you mean path?)",
                  "x.yaml:2:32: motion.depth_mm: 0 is outside (0, inf)",
                  "x.yaml:2:42: motion.steps: 0 is outside [1, 100000]"));
}

TEST(PressEnd, IsTheLastFrameOfTheFirstPress) {
  SampleSpec sample;
  for (const PhaseKind kind : {PhaseKind::press, PhaseKind::shear, PhaseKind::press})
    sample.motion.push_back({.kind = kind, .steps = 2});
  EXPECT_EQ(press_end_frame(sample, {-1, 0, 0, 1, 1, 2, 2}), 2u);
  std::swap(sample.motion[0], sample.motion[1]);
  EXPECT_EQ(press_end_frame(sample, {-1, 0, 0, 1, 1, 2, 2}), 4u) << "two presses in a row are two";
  sample.motion = {{.kind = PhaseKind::shear, .steps = 1}};
  EXPECT_EQ(press_end_frame(sample, {-1, 0}), std::nullopt);
}

}  // namespace sample_spec_test
}  // namespace tacipc
