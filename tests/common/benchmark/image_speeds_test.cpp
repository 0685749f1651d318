#include "common/benchmark/image_speeds.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace image_speeds_test {

TEST(ImageSpeeds, ComeBackAsTheyWereWritten) {
  const ScratchFolder scratch;
  const std::vector<ImageSpeed> speeds{
      {.method = "ours",
       .width_px = 320,
       .height_px = 240,
       .simulation_ms = 527.25,
       .membrane_ms = 0.1,
       .light_ms = 24},
      {.method = "taxim", .width_px = 640, .height_px = 480, .object_ms = 6.5, .membrane_ms = 4.0, .light_ms = 3.0}};
  scratch.file("speeds.csv", to_csv(speeds));
  EXPECT_EQ(read_image_speeds(scratch / "speeds.csv"), speeds);
  EXPECT_EQ(speeds[1].image_ms(), 13.5);
  EXPECT_EQ(speeds[0].total(), "24 + press 527");
  scratch.file("odd.csv", "method,width_px\ntaxim,640\n");
  EXPECT_THROW(read_image_speeds(scratch / "odd.csv"), DataError);
}

}  // namespace image_speeds_test
}  // namespace tacipc
