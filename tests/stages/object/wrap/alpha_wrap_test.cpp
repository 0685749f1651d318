#include "stages/object/wrap/alpha_wrap.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "common/base/error.h"
#include "common/mesh/triangle_tree.h"
#include "stages/object/decimate/mesh_doctor.h"
#include "tests/scratch_folder.h"
#include "tests/stages/object/decimate/shapes.h"

namespace tacipc {
namespace alpha_wrap_test {

constexpr double kMillimetre = 1e-3;
constexpr double kOffset = 0.05 * kMillimetre;

/// What decimate would find: nothing to repair, in one part that does not cross itself, looking outwards.
void expect_sound(const TriangleMesh& wrap) {
  EXPECT_TRUE(is_closed_manifold(wrap));
  EXPECT_GT(signed_volume(wrap), 0.0);
  DoctorReport report;
  treat_mesh(wrap, {}, report);
  EXPECT_FALSE(report.changed_mesh());
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.overlapping_components, 0);
  EXPECT_EQ(report.self_intersections, 0);
}

/// A sphere of 5 mm without its cap of this radius about +z.
TriangleMesh sphere_with_hole(double radius_m) {
  const TriangleMesh ball = sphere(5 * kMillimetre, 4);
  std::vector<int> cap;
  for (int f = 0; f < static_cast<int>(ball.num_triangles()); ++f) {
    const Vector3 centre = ball.positions(ball.triangles.row(f), Eigen::all).colwise().mean();
    if (centre.z() > 0.0 && centre.head<2>().norm() < radius_m) cap.push_back(f);
  }
  return without_faces(ball, cap);
}

TEST(AlphaWrap, IsClosedAndKeepsTheOffset) {
  const TriangleMesh box = make_box(Vector3::Zero(), Vector3(6, 4, 2) * kMillimetre);
  const TriangleMesh wrap = alpha_wrap(box, 0.5 * kMillimetre, kOffset);
  expect_sound(wrap);
  const TriangleTree tree(box);
  for (Eigen::Index v = 0; v < wrap.num_vertices(); ++v) {
    const Vector3 point = wrap.positions.row(v);
    ASSERT_NEAR(std::sqrt(tree.squared_distance(point)), kOffset, 0.02 * kOffset) << point.transpose();
  }
  // Around the box, as large as that and less than the box with rounded edges.
  const double volume = 48e-9, area = 88e-6;
  EXPECT_GT(signed_volume(wrap), volume);
  EXPECT_LT(signed_volume(wrap), volume + 1.05 * kOffset * area);
}

TEST(AlphaWrap, AHoleNarrowerThanTheBallIsBridged) {
  const double hole = 1 * kMillimetre;
  const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(5 * kMillimetre, 3);
  const TriangleMesh closed = alpha_wrap(sphere_with_hole(hole), 1.5 * hole, kOffset);
  expect_sound(closed);
  EXPECT_NEAR(signed_volume(closed), ball, 0.05 * ball);
  // The smaller ball gets in: a shell of two offsets, closed as well.
  const TriangleMesh shell = alpha_wrap(sphere_with_hole(hole), 0.5 * hole, kOffset);
  expect_sound(shell);
  EXPECT_LT(signed_volume(shell), 0.15 * ball);
}

TEST(AlphaWrap, BoxesThatOverlapBecomeOnePart) {
  const TriangleMesh boxes = joined(make_box(Vector3::Zero(), Vector3(4, 4, 4) * kMillimetre),
                                    make_box(Vector3(2, 2, 2) * kMillimetre, Vector3(6, 6, 6) * kMillimetre));
  const TriangleMesh wrap = alpha_wrap(boxes, 0.5 * kMillimetre, kOffset);
  expect_sound(wrap);
  const double both = 120e-9;  // 4³ + 4³ − 2³ mm³
  EXPECT_NEAR(signed_volume(wrap), both, 0.1 * both);
}

TEST(AlphaWrap, TakesWhatNoRepairCloses) {
  // A corner of three sheets that share an edge, one of them turned over, and a face without area.
  const double s = 3 * kMillimetre;
  const TriangleMesh sheets = make_mesh({{0, 0, 0}, {0, 0, s}, {s, 0, 0}, {-s, 0, 0}, {0, s, 0}, {0, 0, s / 2}},
                                        {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {0, 5, 1}});
  DoctorReport report;
  EXPECT_NE(message_of<DataError>([&] { treat_mesh(sheets, {}, report); }), "");
  expect_sound(alpha_wrap(sheets, 0.3 * kMillimetre, kOffset));
}

TEST(AlphaWrap, SaysWhatItCannotWrap) {
  const TriangleMesh line = make_mesh({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 1, 2}});
  EXPECT_EQ(message_of<DataError>([&] { alpha_wrap(line, 0.1, 0.01); }), "the mesh has no face with an area");
}

}  // namespace alpha_wrap_test
}  // namespace tacipc
