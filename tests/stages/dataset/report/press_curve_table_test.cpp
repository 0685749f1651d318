#include "stages/dataset/report/press_curve.h"

#include <gmock/gmock.h>

namespace tacipc {
namespace press_curve_table_test {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(FramesTable, HasAColumnForEachNumberThatAFrameHas) {
  SampleReport sample;
  sample.frames = {{.press_force_n = 0.0}, {.press_force_n = 1.5, .tangential_force_n = 0.25, .slipping = 12}};
  const std::string table = frames_table(sample);
  EXPECT_THAT(table, HasSubstr("<th>tangential force N</th><th>slipping vertices</th><th>Newton iterations</th>"));
  EXPECT_THAT(table, HasSubstr("<tr><td>0</td><td>0</td><td>–</td><td>–</td><td>0</td>"));
  EXPECT_THAT(table, HasSubstr("<tr><td>1</td><td>1.50</td><td>0.250</td><td>12</td><td>0</td>"));
  for (const char* absent : {"phase", "depth", "pressure", "sticking", "imbalance"})
    EXPECT_THAT(table, Not(HasSubstr(absent)));
  EXPECT_EQ(frames_table(SampleReport{}), "");
}

TEST(FramesTable, OfManyFramesItKeepsFirstLastAndTheEndsOfPhases) {
  SampleReport sample;
  sample.frames.resize(306);
  sample.phases = {{"reference", 0, 0}, {"press", 1, 5}, {"shear", 6, 105}, {"twist", 106, 305}};
  const std::string table = frames_table(sample);
  for (const char* row : {"<tr><td>0<", "<tr><td>5<", "<tr><td>105<", "<tr><td>305<", "<tr><td>8<"})
    EXPECT_THAT(table, HasSubstr(row));
  EXPECT_THAT(table, Not(HasSubstr("<tr><td>7<")));
  EXPECT_THAT(table, HasSubstr("Numbers per frame (42 of 306; press.yaml has all)"));
}

}  // namespace press_curve_table_test
}  // namespace tacipc
