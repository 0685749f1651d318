// Gels that the harness makes: closed, outward, of the right volume.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/closed_surface.h"
#include "verification/gel_shapes.h"
#include "verification/object_shapes.h"

namespace tacipc::verify {
namespace gel_shapes_test {

using std::numbers::pi;
using Kind = ObjectShape::Kind;

double volume(const TetMesh& gel) {
  double sum = 0.0;
  for (Eigen::Index t = 0; t < gel.num_tets(); ++t) {
    Matrix3 edges;
    for (int c = 0; c < 3; ++c)
      edges.col(c) = gel.positions.row(gel.tets(t, c + 1)) - gel.positions.row(gel.tets(t, 0));
    const double six = edges.determinant();
    EXPECT_GT(six, 0.0) << "tetrahedron " << t;
    sum += six / 6.0;
  }
  return sum;
}

double area(const TetMesh& gel, BoundaryTag tag) {
  double sum = 0.0;
  const Triangles faces = gel.faces(tag);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Vector3 a = gel.positions.row(faces(f, 0)), b = gel.positions.row(faces(f, 1)),
                  c = gel.positions.row(faces(f, 2));
    sum += 0.5 * (b - a).cross(c - a).norm();
  }
  return sum;
}

BoxGel box() {
  return {.width_m = 0.02,
          .height_m = 0.03,
          .thickness_m = 0.004,
          .near_m = 0.001,
          .near_half_m = 0.003,
          .growth = 1.4,
          .far_m = 0.004,
          .layer_m = 0.0008,
          .layer_growth = 1.2};
}

TEST(GelShapes, GradedLinesKeepNearLengthAndEndOnTheBorder) {
  const auto lines = graded_lines(0.01, 0.001, 0.003, 1.5, 0.004, 0.0005);
  EXPECT_EQ(lines.size() % 2, 1u);
  EXPECT_EQ(lines.front(), -0.01);
  EXPECT_EQ(lines.back(), 0.01);
  EXPECT_NEAR(lines[lines.size() - 2], 0.0095, 1e-15);
  const std::size_t middle = lines.size() / 2;
  EXPECT_EQ(lines[middle], 0.0);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(lines[middle + i + 1] - lines[middle + i], 0.001, 1e-15);
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) EXPECT_LT(lines[i], lines[i + 1]);
}

TEST(GelShapes, BoxFillsItsVolumeAndIsClosed) {
  const TetMesh gel = make_gel({box()}, "");
  EXPECT_NEAR(volume(gel) / (0.02 * 0.03 * 0.004), 1.0, 1e-12);
  expect_closed(gel.boundary);
  EXPECT_NEAR(area(gel, BoundaryTag::front), 0.02 * 0.03, 1e-15);
  EXPECT_NEAR(area(gel, BoundaryTag::glued), 0.02 * 0.03, 1e-15);
  EXPECT_NEAR(area(gel, BoundaryTag::side), 2 * (0.02 + 0.03) * 0.004, 1e-15);
  const GelShape shape = shape_of({box()}, gel);
  EXPECT_NEAR(shape.width_m, 0.02, 1e-15);
  EXPECT_NEAR(shape.thickness_m, 0.004, 1e-15);
}

TEST(GelShapes, RingsLieAtTheFocusAndFillAPrism) {
  const RingGel rings{.radius_m = 0.01,
                      .thickness_m = 0.004,
                      .sectors = 12,
                      .focus_from_m = 0.001,
                      .focus_to_m = 0.0013,
                      .near_m = 0.0001,
                      .growth = 1.5,
                      .far_m = 0.003,
                      .layer_m = 0.0002,
                      .layer_growth = 1.5};
  const auto radii = ring_radii(rings);
  const auto from = std::find(radii.begin(), radii.end(), 0.001);
  ASSERT_NE(from, radii.end());
  ASSERT_GE(radii.end() - from, 4);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(from[i + 1] - from[i], 0.0001, 1e-15);
  EXPECT_EQ(radii.front(), 0.0);
  EXPECT_EQ(radii.back(), 0.01);
  EXPECT_TRUE(std::is_sorted(radii.begin(), radii.end()));

  const TetMesh gel = make_gel({rings}, "");
  const double polygon = 6.0 * 0.01 * 0.01 * std::sin(2.0 * pi / 12.0);
  EXPECT_NEAR(volume(gel) / (polygon * 0.004), 1.0, 1e-12);
  expect_closed(gel.boundary);
  EXPECT_NEAR(area(gel, BoundaryTag::front), polygon, 1e-15);
  EXPECT_NEAR(area(gel, BoundaryTag::glued), polygon, 1e-15);
  // One vertex on the axis for each layer.
  int on_axis = 0;
  for (Eigen::Index v = 0; v < gel.num_vertices(); ++v) on_axis += gel.positions.row(v).head<2>().norm() == 0.0;
  EXPECT_EQ(gel.num_vertices() % on_axis, 0);
  EXPECT_EQ(gel.num_vertices() / on_axis, 1 + 12 * (std::ssize(radii) - 1));
  EXPECT_NEAR(shape_of({rings}, gel).radius_m, 0.01, 1e-15);
}

TEST(GelShapes, CutCornersTakeAwayFourPrisms) {
  BoxGel cut = box();
  cut.corner_cut_m = 0.001;
  const TetMesh gel = make_gel({cut}, "");
  EXPECT_NEAR(volume(gel), (0.02 * 0.03 - 4 * 0.5e-6) * 0.004, 1e-15);
  expect_closed(gel.boundary);
  // The diagonals of the corner cells lie along the cut: nothing of the gel is beyond it.
  EXPECT_LE((gel.positions.col(0).array().abs() + gel.positions.col(1).array().abs()).maxCoeff(),
            0.01 + 0.015 - 0.001 + 1e-12);
}

TEST(GelShapes, CrownFollowsItsProfile) {
  BoxGel crowned = box();
  crowned.crown = Crown{.half_x_m = 0.007, .half_y_m = 0.01, .sag_m = 0.0002, .edge_sag_m = 0.001};
  const TetMesh gel = make_gel({crowned}, "");
  expect_closed(gel.boundary);
  volume(gel);
  for (const int v : gel.vertices(BoundaryTag::front)) {
    const Vector3 x = gel.positions.row(v);
    if (std::abs(x.y()) < 1e-12 && std::abs(x.x()) <= 0.007) {
      EXPECT_NEAR(x.z(), -0.0002 * x.x() * x.x() / 49e-6, 1e-15);
    }
    if (std::abs(x.y()) < 1e-12 && std::abs(std::abs(x.x()) - 0.01) < 1e-12) {
      EXPECT_NEAR(x.z(), -0.001, 1e-15);
    }
  }
  EXPECT_NEAR(gel.positions.col(2).maxCoeff(), 0.0, 1e-15);
  EXPECT_NEAR(gel.positions.col(2).minCoeff(), -0.004, 1e-15);
}

}  // namespace gel_shapes_test
}  // namespace tacipc::verify
