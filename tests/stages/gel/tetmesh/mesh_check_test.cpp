#include "stages/gel/tetmesh/mesh_check.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "stages/gel/tetmesh/smooth.h"
#include "tests/scratch_folder.h"
#include "tests/stages/gel/tetmesh/gels.h"

namespace tacipc {
namespace mesh_check_test {

const Vector3 kA(1, 1, 1), kB(1, -1, -1), kC(-1, 1, -1), kD(-1, -1, 1);

TEST(DihedralAngles, RegularAndCornerTet) {
  const double regular = std::acos(1.0 / 3.0) * 180.0 / std::numbers::pi;
  EXPECT_NEAR(dihedral_angles(kA, kB, kC, kD).smallest_deg, regular, 1e-12);
  EXPECT_NEAR(dihedral_angles(kA, kB, kC, kD).largest_deg, regular, 1e-12);
  const DihedralAngles corner = dihedral_angles({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_NEAR(corner.smallest_deg, std::acos(1.0 / std::sqrt(3.0)) * 180.0 / std::numbers::pi, 1e-12);
  EXPECT_NEAR(corner.largest_deg, 90.0, 1e-12);
}

TEST(SmallestDihedralSine, AgreesWithTheAngles) {
  EXPECT_NEAR(std::abs(smallest_dihedral_sine(kA, kB, kC, kD)), std::sqrt(8.0) / 3.0, 1e-14);
  const Vector3 a(0, 0, 0), b(1, 0, 0), c(0.2, 1.1, 0), d(0.4, 0.3, 0.1);
  const DihedralAngles angles = dihedral_angles(a, b, c, d);
  const double sine = std::min(std::sin(angles.smallest_deg * std::numbers::pi / 180.0),
                               std::sin(angles.largest_deg * std::numbers::pi / 180.0));
  EXPECT_NEAR(smallest_dihedral_sine(a, b, c, d), sine, 1e-14);
  EXPECT_LT(smallest_dihedral_sine(b, a, c, d), 0.0);
}

TEST(Smooth, BringsAStrayVertexBackAndLeavesTheSurface) {
  // An octahedron around one inner vertex, pushed almost onto a face.
  TetMesh mesh;
  mesh.positions.resize(7, 3);
  mesh.positions << 0.32, 0.32, 0.32, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  mesh.tets.resize(8, 4);
  mesh.boundary.resize(8, 3);
  int row = 0;
  for (const int x : {1, 2})
    for (const int y : {3, 4})
      for (const int z : {5, 6}) {
        const bool even = ((x == 2) + (y == 4) + (z == 6)) % 2 == 0;
        mesh.boundary.row(row) << x, (even ? y : z), (even ? z : y);
        mesh.tets.row(row) << 0, mesh.boundary.row(row);
        mesh.tags.push_back(BoundaryTag::front);
        ++row;
      }
  const Positions before = mesh.positions;
  smooth(mesh, 20);
  EXPECT_LT(mesh.positions.row(0).norm(), 0.1);
  EXPECT_EQ(mesh.positions.bottomRows(6), before.bottomRows(6));
}

class CheckGelTest : public ::testing::Test {
 protected:
  std::string fault() const {
    return message_of<DataError>([&] { check_gel(mesh_, gel_, {}, "gel"); });
  }

  GelShape gel_ = mctac_gel();
  TetMesh mesh_ = generate_gel(gel_, preset("tiny"));
};

TEST_F(CheckGelTest, AcceptsAWholeGel) { EXPECT_EQ(fault(), ""); }

TEST_F(CheckGelTest, InvertedTet) {
  std::swap(mesh_.tets(7, 0), mesh_.tets(7, 1));
  EXPECT_EQ(fault(), "gel: tet 7 has no positive volume");
}

TEST_F(CheckGelTest, FlatTet) {
  mesh_.positions.row(mesh_.tets(0, 0)) =
      (mesh_.positions.row(mesh_.tets(0, 1)) + mesh_.positions.row(mesh_.tets(0, 2))) / 2.0;
  EXPECT_NE(fault().find(" has no positive volume"), std::string::npos) << fault();
}

TEST_F(CheckGelTest, LooseVertex) {
  mesh_.positions.conservativeResize(mesh_.num_vertices() + 1, 3);
  mesh_.positions.row(mesh_.num_vertices() - 1).setZero();
  EXPECT_EQ(fault(), fmt::format("gel: 1 of {0} vertices belong to no tet, the first is vertex {1}",
                                 mesh_.num_vertices(), mesh_.num_vertices() - 1));
}

TEST_F(CheckGelTest, TetGivenTwice) {
  mesh_.tets.conservativeResize(mesh_.num_tets() + 1, 4);
  mesh_.tets.row(mesh_.num_tets() - 1) = mesh_.tets.row(0);
  EXPECT_EQ(fault().find("gel: two tets lie on the same side of the face of vertices "), 0u) << fault();
}

TEST_F(CheckGelTest, MissingBoundaryTriangle) {
  mesh_.boundary.conservativeResize(mesh_.boundary.rows() - 1, 3);
  mesh_.tags.pop_back();
  EXPECT_EQ(fault(), "gel: the tagged triangles are not the boundary of the tets");
}

TEST_F(CheckGelTest, MissingFace) {
  for (BoundaryTag& tag : mesh_.tags)
    if (tag == BoundaryTag::glued) tag = BoundaryTag::side;
  EXPECT_EQ(fault(), "gel: no boundary triangle belongs to the glued face");
}

TEST_F(CheckGelTest, FrontVertexOffTheFront) {
  const int v = mesh_.vertices(BoundaryTag::front)[40];
  mesh_.positions(v, 2) = -1e-5;
  EXPECT_EQ(fault(), fmt::format("gel: front vertex {} lies 0.01 mm off the sensor's front face, more than 0 mm", v));
}

TEST(CheckGel, NothingAtAll) {
  EXPECT_EQ(message_of<DataError>([] { check_gel({}, mctac_gel(), {}, "gel"); }), "gel: has no tets");
}

}  // namespace mesh_check_test
}  // namespace tacipc
