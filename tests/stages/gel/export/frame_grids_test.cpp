#include "stages/gel/export/frame_grids.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "stages/gel/export/open_press.h"
#include "tests/stages/gel/export/pressed_cube.h"

namespace tacipc {
namespace frame_grids_test {

using ::testing::Each;
using ::testing::ElementsAre;

class FrameGridsTest : public ::testing::Test {
 protected:
  void SetUp() override { write_pressed_cube(scratch_); }

  PressFolder press() const {
    return open_press(scratch_ / "press", scratch_ / "gel.msh", read_tet_mesh(scratch_ / "gel.msh"),
                      scratch_ / "object.ply");
  }
  std::string error() const {
    return message_of<DataError>([&] { press(); });
  }
  std::string path(const std::string& name) const { return (scratch_ / name).string(); }
  template <typename T = double>
  static const std::vector<T>& values(const std::vector<VtuArray>& arrays, const std::string& name) {
    for (const VtuArray& array : arrays)
      if (array.name == name) return std::get<std::vector<T>>(array.values);
    throw std::out_of_range(name);
  }

  ScratchFolder scratch_;
};

TEST_F(FrameGridsTest, TheSurfaceHasTheBoundarysVerticesAndTheFrontsForces) {
  const TetMesh gel = read_tet_mesh(scratch_ / "gel.msh");
  const VtuGrid grid = surface_grid(gel, press(), 1);
  ASSERT_EQ(grid.points.rows(), 8);  // not the one inside
  ASSERT_EQ(grid.cells.rows(), 12);
  EXPECT_DOUBLE_EQ(grid.points(5, 2), -0.002);
  EXPECT_THAT(values<std::uint8_t>(grid.point_data, "contact_state"), ElementsAre(0, 0, 0, 0, 0, 1, 0, 2));
  const auto& normal = values(grid.point_data, "normal_force");
  const auto& friction = values(grid.point_data, "friction_force");
  const auto& displacement = values(grid.point_data, "displacement");
  for (std::size_t v = 0; v < 8; ++v) {
    EXPECT_EQ(normal[3 * v + 2], v == 5 ? -2.0 : v == 7 ? -4.0 : 0.0);
    EXPECT_EQ(friction[3 * v], v == 5 ? 0.25 : v == 7 ? 0.75 : 0.0);
    EXPECT_DOUBLE_EQ(displacement[3 * v + 2], v < 4 ? 0.0 : -0.002);
    EXPECT_EQ(displacement[3 * v], 0.0);
  }
  const auto& boundary = values<std::uint8_t>(grid.cell_data, "boundary");
  EXPECT_EQ(std::count(boundary.begin(), boundary.end(), 1), 2);
  EXPECT_EQ(std::count(boundary.begin(), boundary.end(), 2), 8);
  EXPECT_EQ(std::count(boundary.begin(), boundary.end(), 3), 2);
  for (Eigen::Index c = 0; c < 12; ++c) {
    if (boundary[static_cast<std::size_t>(c)] == 1) {
      EXPECT_GE(grid.cells.row(c).minCoeff(), 4);
    }
  }
}

TEST_F(FrameGridsTest, TheVolumeHasTheRatioOfEachTetrahedron) {
  const TetMesh gel = read_tet_mesh(scratch_ / "gel.msh");
  const VtuGrid rest = volume_grid(gel, press(), 0), grid = volume_grid(gel, press(), 1);
  ASSERT_EQ(grid.points.rows(), 9);
  ASSERT_EQ(grid.cells.rows(), 12);
  EXPECT_THAT(values(rest.cell_data, "volume_ratio"), Each(1.0));
  EXPECT_THAT(values(grid.cell_data, "volume_ratio"), Each(::testing::DoubleNear(0.8, 1e-15)));
  EXPECT_DOUBLE_EQ(values(grid.point_data, "displacement")[3 * 8 + 2], -0.001);
  EXPECT_EQ(values(grid.point_data, "normal_force")[3 * 7 + 2], -4.0);
  EXPECT_EQ(values(grid.point_data, "friction_force")[3 * 8], 0.0);
}

/// Where the press has stress: of each tetrahedron in VTK's order, turned with the gel; pressure and shear on the
/// front.
TEST_F(FrameGridsTest, StressTurnsWithTheGel) {
  const TetMesh gel = read_tet_mesh(scratch_ / "gel.msh");
  for (const VtuArray& array : volume_grid(gel, press(), 1).cell_data) EXPECT_NE(array.name, "stress");
  std::vector<double> stress(2 * 12 * 6, 0.0), pressure(2 * 4 * 2, 0.0), shear(2 * 4 * 2 * 3, 0.0);
  for (std::size_t t = 0; t < 12; ++t)
    for (std::size_t i = 0; i < 6; ++i) stress[(12 + t) * 6 + i] = 1.0 + static_cast<double>(i);  // xx yy zz yz xz xy
  pressure[(4 + 1) * 2] = 70.0, pressure[(4 + 1) * 2 + 1] = 60.0;
  shear[((4 + 3) * 2 + 0) * 3 + 1] = 5.0;
  write_npy(scratch_ / "press/stress.npy", {2, 12, 6}, stress.data());
  write_npy(scratch_ / "press/front_pressure.npy", {2, 4, 2}, pressure.data());
  write_npy(scratch_ / "press/front_shear.npy", {2, 4, 2, 3}, shear.data());
  const VtuGrid volume = volume_grid(gel, press(), 1), surface = surface_grid(gel, press(), 1);
  const auto first = [](const VtuGrid& grid) {
    const auto& all = values(grid.cell_data, "stress");
    return std::vector<double>(all.begin() + 6, all.begin() + 12);
  };
  EXPECT_THAT(first(volume), ElementsAre(1, 2, 3, 6, 4, 5)) << "xx yy zz xy yz xz";
  const auto& on_vertices = values(surface.point_data, "pressure");
  for (std::size_t v = 0; v < 8; ++v) {
    EXPECT_EQ(on_vertices[v], v == 5 ? 70.0 : 0.0);
    EXPECT_EQ(values(surface.point_data, "shear")[3 * v + 1], v == 7 ? 5.0 : 0.0);
  }
  // A quarter turn about z: x to y, y to −x.
  Matrix4 turn = Matrix4::Identity();
  turn.topLeftCorner<3, 3>() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  turn.topRightCorner<3, 1>() << 7, 8, 9;
  EXPECT_THAT(first(in_world(volume, turn)), ElementsAre(2, 1, 3, -6, 5, -4));
}

TEST_F(FrameGridsTest, TheObjectIsWhereItsPosePutsIt) {
  const TriangleMesh object = read_triangle_mesh(scratch_ / "object.ply", 1.0);
  EXPECT_EQ(object_grid(object, press().poses()[0]).points, object.positions);
  const VtuGrid grid = object_grid(object, press().poses()[1]);
  EXPECT_EQ(grid.points, (Positions{{1, 3, 3}, {0, 2, 3}, {1, 2, 4}, {1, 2, 3}}));
  EXPECT_EQ(grid.cells, object.triangles);
}

TEST_F(FrameGridsTest, InTheWorldPointsAreMovedAndVectorsTurned) {
  const TetMesh gel = read_tet_mesh(scratch_ / "gel.msh");
  const Matrix4 pose = pressed_scene_fingers()[3];  // z of S along −x
  const VtuGrid in_s = surface_grid(gel, press(), 1), grid = in_world(in_s, pose);
  const Positions expected =
      (in_s.points * pose.topLeftCorner<3, 3>().transpose()).rowwise() + pose.topRightCorner<3, 1>().transpose();
  EXPECT_LT((grid.points - expected).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_DOUBLE_EQ(values(grid.point_data, "normal_force")[3 * 7], 4.0);
  EXPECT_DOUBLE_EQ(values(grid.point_data, "displacement")[3 * 7], 0.002);
  EXPECT_EQ(values(grid.point_data, "normal_force")[3 * 7 + 2], 0.0);
  EXPECT_THAT(values<std::uint8_t>(grid.point_data, "contact_state"), ElementsAre(0, 0, 0, 0, 0, 1, 0, 2));
  const VtuGrid volume = volume_grid(gel, press(), 1);
  EXPECT_EQ(values(in_world(volume, pose).cell_data, "volume_ratio"), values(volume.cell_data, "volume_ratio"));
}

TEST_F(FrameGridsTest, WhatDoesNotBelongTogetherIsRefused) {
  EXPECT_EQ(error(), "");
  const std::vector<double> zeros(200, 0.0);
  write_npy(path("press/contact_force.npy"), {2, 9, 3}, zeros.data());
  EXPECT_EQ(error(), path("press/contact_force.npy") + ": has the shape (2, 9, 3), expected (2, 4, 2, 3)");
  write_npy(path("press/positions.npy"), {2, 8, 3}, zeros.data());
  EXPECT_EQ(error(), path("press/positions.npy") + ": has the shape (2, 8, 3), expected (frames, 9, 3)");
  write_npy(path("press/positions.npy"), {0, 9, 3}, zeros.data());
  EXPECT_EQ(error(), path("press/positions.npy") + ": has no frames");
  write_npy(path("press/positions.npy"), {2, 9, 3}, zeros.data());
  const std::vector<std::int32_t> front{4, 5, 6, 8};
  write_npy(path("press/front_vertices.npy"), {4}, front.data());
  EXPECT_EQ(error(), path("press/front_vertices.npy") + ": does not list the front of the gel");
  scratch_.file("object.ply", read_file(path("object.ply")) + " ");
  EXPECT_EQ(error(), path("object.ply") + ": is not the object that " + path("press/press.yaml") + " was made with");
  scratch_.file("gel.msh", read_file(path("gel.msh")) + "\n");
  EXPECT_EQ(error(), path("gel.msh") + ": is not the gel that " + path("press/press.yaml") + " was made with");
  std::filesystem::remove(path("press/press.yaml"));
  EXPECT_EQ(error(), path("press") + ": has no press.yaml, so the press did not finish");
}

}  // namespace frame_grids_test
}  // namespace tacipc
