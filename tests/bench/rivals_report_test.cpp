#include "bench/rivals_report.h"

#include <gtest/gtest.h>

namespace tacipc::bench {
namespace rivals_report_test {

TEST(RivalsTable, HasARowPerMethodAndColumnsPerSize) {
  const std::vector<ImageSpeed> speeds{
      {.method = "ours", .width_px = 32, .height_px = 24, .simulation_ms = 527.4, .membrane_ms = 14.6, .light_ms = 24},
      {.method = "taxim", .width_px = 32, .height_px = 24, .object_ms = 6, .membrane_ms = 4, .light_ms = 3},
      {.method = "ours", .width_px = 64, .height_px = 48, .simulation_ms = 527.4, .membrane_ms = 44, .light_ms = 97},
      {.method = "taxim", .width_px = 64, .height_px = 48, .object_ms = 11, .membrane_ms = 45, .light_ms = 14}};
  EXPECT_EQ(
      rivals_table(speeds, 40, "a processor", 1.5),
      "| CPU ms of a frame | 32 × 24: object | membrane | light | all | 64 × 48: object | membrane | light | all |\n"
      "|---|---|---|---|---|---|---|---|---|\n"
      "| ours |  | 15 | 24 | 39 + press 527 |  | 44 | 97 | 141 + press 527 |\n"
      "| taxim | 6 | 4 | 3 | 13 | 11 | 45 | 14 | 70 |\n"
      "\n"
      "One thread of: a processor; in the minute before, 1.5 processes wanted a processor. Medians over frames of "
      "one press in images of these sizes, files not counted. *Press*: the simulation before it, all of its "
      "presses over all of their frames (40 of TacIPC's), whatever the images' size.\n");
}

}  // namespace rivals_report_test
}  // namespace tacipc::bench
