#include "common/benchmark/measured_field.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "tests/scratch_folder.h"
#include "tests/shared_data.h"

namespace tacipc {
namespace measured_field_test {

TEST(MeasuredField, ReadsRestAndDisplacement) {
  const ScratchFolder folder;
  const MarkerField field = read_marker_field(folder.file("f.csv", "Mx,My,dx,dy\n25,11,-1,-2\r\n54.5,12,0,3\n\n"));
  ASSERT_EQ(field.rest_px.cols(), 2);
  EXPECT_EQ(field.rest_px.col(1), Eigen::Vector2d(54.5, 12));
  EXPECT_EQ(field.moved_px.col(0), Eigen::Vector2d(-1, -2));
}

TEST(MeasuredField, SaysWhichLineIsWrong) {
  const ScratchFolder folder;
  const auto message = [&](const std::string& text) {
    const auto file = folder.file("f.csv", text);
    return message_of<DataError>([&] { read_marker_field(file); }).substr(file.string().size());
  };
  EXPECT_EQ(message("x,y\n"), ":1: expected the header Mx,My,dx,dy");
  EXPECT_EQ(message("Mx,My,dx,dy\n1,2,3,4\n1,2,3\n"), ":3: expected four numbers");
  EXPECT_EQ(message("Mx,My,dx,dy\n1,2,3,4,5\n"), ":2: expected four numbers");
  EXPECT_EQ(message("Mx,My,dx,dy\n1,2,nan,4\n"), ":2: expected four numbers");
  EXPECT_EQ(message("Mx,My,dx,dy\n"), ": has no markers");
}

TEST(MeasuredField, Medians) {
  Eigen::Matrix2Xd v(2, 4);
  v << 1, 5, 2, 9, 0, 0, 0, -8;
  EXPECT_EQ(median_of(v), Eigen::Vector2d(3.5, 0));
  EXPECT_EQ(median_of(v.leftCols(3)), Eigen::Vector2d(2, 0));
}

TEST(MeasuredField, ThePublishedPressIsOffByOnePixel) {
  TACIPC_SHARED_DATA(file, "data/fots_markers/0.csv");
  const MarkerField field = read_marker_field(file);
  ASSERT_EQ(field.rest_px.cols(), 99);
  EXPECT_EQ(median_of(field.moved_px), Eigen::Vector2d(1, -1));
}

TEST(Quiver, DrawsEachMarkerAtItsScale) {
  const MarkerField field{.rest_px = Eigen::Vector2d(10, 20), .moved_px = Eigen::Vector2d(3, 0)};
  const std::string svg = quiver_svg(field, Eigen::Vector2d(0, -1), {40, 30}, 4.0, "press");
  EXPECT_NE(svg.find("stroke=\"#c22626\" stroke-width=\"1.6\" d=\"M20.0 40.0l24.0 0.0m"), std::string::npos) << svg;
  EXPECT_NE(svg.find("stroke=\"#1f5fa8\" stroke-width=\"1.6\" d=\"M20.0 40.0l0.0 -8.0m"), std::string::npos) << svg;
  EXPECT_NE(svg.find("arrows 4 times as long"), std::string::npos);
}

}  // namespace measured_field_test
}  // namespace tacipc
