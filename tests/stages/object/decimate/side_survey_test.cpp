#include "stages/object/decimate/side_survey.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "common/sample/placement.h"
#include "tests/stages/object/decimate/shapes.h"

namespace tacipc {
namespace side_survey_test {

constexpr double kSize = 20e-3, kStamp = 0.4e-3;
const SensorWindow kWindow{.size_m = {15e-3, 11.25e-3}, .usual = "-z"};

/// A cube of 20 mm whose side +y carries a square, raised by 0.4 mm, between these millimetres of x and z.
TriangleMesh stamped(double low, double high) {
  TriangleMesh mesh = cube(kSize, 20);
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v) {
    const Eigen::RowVector3d p = 1e3 * mesh.positions.row(v);
    const auto within = [&](double at) { return at > low - 1e-6 && at < high + 1e-6; };
    if (p.y() > 19.9 && within(p.x()) && within(p.z())) mesh.positions(v, 1) += kStamp;
  }
  return mesh;
}

const SideView& view_of(const SideSurvey& survey, const std::string& side) {
  for (const SideView& view : survey.views)
    if (view.side == side) return view;
  throw std::logic_error(side);
}

TEST(SideSurvey, FindsTheSideWithReliefAndMeasuresIt) {
  const SideSurvey survey = survey_sides(stamped(8, 12), kWindow, "");
  EXPECT_EQ(survey.side().side, "+y");
  EXPECT_FALSE(survey.given);
  // Its contours are squares of 4 to 6 mm; each counts for its part of the height that a press reaches.
  EXPECT_NEAR(survey.side().relief_m, 4 * 5e-3 * kStamp / SideSurvey::kPressDepth, 1e-3);
  EXPECT_EQ(survey.side().place_m, (std::array{0.0, 0.0}));
  EXPECT_LT(view_of(survey, "-y").relief_m, 0.1e-3);
  // From beside, the stamp stands out of their rim: 0.4 mm high, 4 to 6 mm long.
  for (const char* beside : {"-x", "+x", "-z", "+z"})
    EXPECT_NEAR(view_of(survey, beside).relief_m, 5e-3, 1e-3) << beside;
  EXPECT_TRUE(survey.wider_than_window());
  EXPECT_FALSE(survey.uniform());
}

TEST(SideSurvey, FindsThePlaceWithReliefAsThePressWillPlaceIt) {
  const TriangleMesh mesh = stamped(2, 5);
  const SideSurvey survey = survey_sides(mesh, kWindow, "");
  ASSERT_EQ(survey.side().side, "+y");
  const auto& place_m = survey.side().place_m;
  const Matrix4 pose = place(mesh.positions, {.face = "+y", .center_x_m = -place_m[0], .center_y_m = -place_m[1]}, 0.0);
  const Positions placed = transformed(pose, mesh.positions);
  int stamp = 0;
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v) {
    if (mesh.positions(v, 1) < kSize + 0.5 * kStamp) continue;
    ++stamp;
    EXPECT_LT(std::abs(placed(v, 0)), 0.5 * kWindow.size_m[0]);
    EXPECT_LT(std::abs(placed(v, 1)), 0.5 * kWindow.size_m[1]);
    EXPECT_LT(placed(v, 2), 1e-9) << "the stamp touches first";
  }
  EXPECT_EQ(stamp, 16);
  EXPECT_GT(survey.side().relief_m, 1.1 * survey.side().centered_relief_m);
}

TEST(SideSurvey, ATipIsPressedRatherThanTheSocketBelow) {
  // As printed indenters are: a pin on top, a square hole in the bottom with five times the pin's contour.
  TriangleMesh mesh = stamped(9, 11);
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v) {
    const Eigen::RowVector3d p = 1e3 * mesh.positions.row(v);
    const auto within = [](double at) { return at > 3.9 && at < 16.1; };
    if (p.y() < 0.1 && within(p.x()) && within(p.z())) mesh.positions(v, 1) += 5e-3;
    if (p.y() > 20.1) mesh.positions(v, 1) += 2e-3;
  }
  const SideSurvey survey = survey_sides(mesh, {.size_m = kWindow.size_m, .usual = "-y"}, "");
  EXPECT_GT(view_of(survey, "-y").relief_m, 2.0 * view_of(survey, "+y").relief_m);
  EXPECT_GT(view_of(survey, "-y").rim_touching, 0.9);
  EXPECT_LT(view_of(survey, "+y").rim_touching, 0.1);
  EXPECT_EQ(survey.side().side, "+y");
}

TEST(SideSurvey, KeepsTheUsualSideUnlessAnotherIsBetter) {
  EXPECT_EQ(survey_sides(sphere(5e-3, 4), kWindow, "").side().side, "-z");
  EXPECT_EQ(survey_sides(sphere(5e-3, 4), {.size_m = kWindow.size_m, .usual = "+x"}, "").side().side, "+x");
  const SideSurvey asked = survey_sides(stamped(8, 12), kWindow, "-y");
  EXPECT_TRUE(asked.given);
  EXPECT_EQ(asked.side().side, "-y");
  EXPECT_TRUE(asked.uniform());
}

TEST(SideSurvey, AFlatFaceIsUniformOnlyWhereItFillsTheWindow) {
  EXPECT_TRUE(survey_sides(cube(kSize), kWindow, "").uniform());
  const SideSurvey small = survey_sides(cube(8e-3), kWindow, "");
  EXPECT_FALSE(small.uniform());
  EXPECT_FALSE(small.wider_than_window());
  EXPECT_EQ(small.side().extent_m[0], 8e-3);
}

TEST(SideSurvey, ASheetSeenFromItsEdgeHasNoRelief) {
  const TriangleMesh upright =
      make_mesh({{0, 0, 0}, {kSize, 0, 0}, {kSize, 0, kSize}, {0, 0, kSize}}, {{0, 1, 2}, {0, 2, 3}});
  const SideSurvey survey = survey_sides(upright, kWindow, "-z");
  EXPECT_EQ(survey.side().relief_m, 0.0);
  EXPECT_EQ(survey.side().height.width, 0);
  EXPECT_EQ(survey_sides(upright, kWindow, "").side().side, "+y") << "the first that shows the sheet";
  EXPECT_EQ(picture_of_sides(survey).width, 600);
}

TEST(SideSurvey, ThePictureFramesThePressedSide) {
  const SideSurvey survey = survey_sides(stamped(8, 12), kWindow, "");
  const ByteImage picture = picture_of_sides(survey);
  ASSERT_EQ(picture.width, 600);
  ASSERT_EQ(picture.height, 400);
  // +y is the middle tile of the upper row; its stamp is lighter than what is 0.4 mm behind it.
  EXPECT_EQ(picture.at(202, 100, 1), 112);
  EXPECT_EQ(picture.at(2, 100, 1), 243);
  EXPECT_GT(picture.at(300, 100, 1), picture.at(300, 30, 1) + 50);
}

}  // namespace side_survey_test
}  // namespace tacipc
