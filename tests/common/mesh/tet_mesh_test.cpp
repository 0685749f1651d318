#include "common/mesh/tet_mesh.h"

#include "common/base/error.h"
#include "tests/common/sample_files.h"
#include "tests/scratch_folder.h"
#include "tests/shared_data.h"

namespace tacipc {
namespace tet_mesh_test {

/// Two tets on the common face 1 2 3: six outward faces.
TetMesh two_tets() {
  TetMesh mesh;
  mesh.positions = (Positions(5, 3) << 0, 0, 0, 1e-3, 0, 0, 0, 1e-3, 0, 0, 0, 1e-3, 1e-3, 1e-3, 1.0 / 3.0e3).finished();
  mesh.tets = (Tetrahedra(2, 4) << 0, 1, 2, 3, 1, 2, 3, 4).finished();
  mesh.boundary = boundary_triangles(mesh.tets, 5);
  mesh.tags = {BoundaryTag::side, BoundaryTag::glued, BoundaryTag::front,
               BoundaryTag::side, BoundaryTag::front, BoundaryTag::front};
  return mesh;
}

TEST(TetMesh, BoundaryIsWhatOneTetHasAndLooksOutwards) {
  const TetMesh mesh = two_tets();
  ASSERT_EQ(mesh.boundary.rows(), 6);
  const Eigen::RowVector3d centre = mesh.positions.colwise().mean();
  for (Eigen::Index f = 0; f < 6; ++f) {
    const Eigen::RowVector3d a = mesh.positions.row(mesh.boundary(f, 0));
    const Eigen::RowVector3d u = mesh.positions.row(mesh.boundary(f, 1)) - a;
    const Eigen::RowVector3d v = mesh.positions.row(mesh.boundary(f, 2)) - a;
    const Eigen::RowVector3d n(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]);
    EXPECT_GT(n.dot(a - centre), 0.0) << "face " << f;
  }
  EXPECT_EQ(mesh.faces(BoundaryTag::glued).rows(), 1);
  EXPECT_EQ(mesh.vertices(BoundaryTag::side), (std::vector<int>{0, 2, 3, 4}));
}

TEST(TetMesh, ThreeTetsOnOneFaceAreRefused) {
  const Tetrahedra tets = (Tetrahedra(3, 4) << 0, 1, 2, 3, 1, 2, 3, 4, 3, 2, 1, 5).finished();
  EXPECT_EQ(message_of<DataError>([&] { boundary_triangles(tets, 6); }), "3 tets share the face of vertices 1, 2, 3");
  EXPECT_EQ(message_of<DataError>([&] { boundary_triangles(tets, 5); }),
            "tet 2 refers to vertex 5, but there are 5 vertices");
}

TEST(TetMesh, JoinedHasTheRowsOfEachOneAfterAnother) {
  const TetMesh one = two_tets();
  TetMesh other = one;
  other.positions.col(2).array() += 1.0;
  std::swap(other.tags[0], other.tags[1]);
  const TetMesh both = joined({one, other, one});
  ASSERT_EQ(both.num_vertices(), 15);
  ASSERT_EQ(both.num_tets(), 6);
  ASSERT_EQ(both.tags.size(), 18u);
  for (const auto& [mesh, k] : {std::pair(one, 0), std::pair(other, 1), std::pair(one, 2)}) {
    EXPECT_EQ(both.positions.middleRows(5 * k, 5), mesh.positions);
    EXPECT_EQ(both.tets.middleRows(2 * k, 2), Tetrahedra(mesh.tets.array() + 5 * k));
    EXPECT_EQ(both.boundary.middleRows(6 * k, 6), Triangles(mesh.boundary.array() + 5 * k));
    EXPECT_TRUE(std::equal(mesh.tags.begin(), mesh.tags.end(), both.tags.begin() + 6 * k));
  }
  EXPECT_EQ(boundary_triangles(both.tets, both.num_vertices()), both.boundary);
}

TEST(MshFile, EveryVersionGivesTheSameTetAndTaggedTriangle) {
  const ScratchFolder scratch;
  const std::vector<std::string> files{msh22_ascii(),
                                       msh22_binary(std::endian::little),
                                       msh22_binary(std::endian::big),
                                       msh41_ascii(),
                                       msh41_binary(std::endian::little),
                                       msh41_binary(std::endian::big),
                                       "\xEF\xBB\xBF" + msh22_ascii(),
                                       "\xEF\xBB\xBF" + msh41_ascii()};
  for (std::size_t i = 0; i < files.size(); ++i) {
    const MshContent content = read_msh(scratch.file("a.msh", files[i]));
    ASSERT_EQ(content.positions.rows(), 4) << i;
    EXPECT_EQ(content.positions(1, 0), 1.0) << i;
    EXPECT_EQ(content.tets, Eigen::RowVector4i(0, 1, 2, 3)) << i;
    EXPECT_EQ(content.triangles, Eigen::RowVector3i(0, 2, 1)) << i;
    EXPECT_EQ(content.triangle_tags, std::vector<int>{2}) << i;
  }
}

TEST(MshFile, TaggedMeshComesBackBitByBit) {
  const ScratchFolder scratch;
  const TetMesh mesh = two_tets();
  write_tet_mesh(scratch / "a.msh", mesh);
  const TetMesh back = read_tet_mesh(scratch / "a.msh");
  EXPECT_EQ(back.positions, mesh.positions);
  EXPECT_EQ(back.tets, mesh.tets);
  for (const BoundaryTag tag : {BoundaryTag::front, BoundaryTag::side, BoundaryTag::glued})
    EXPECT_EQ(back.faces(tag), mesh.faces(tag));
  const std::string first = read_file(scratch / "a.msh");
  write_tet_mesh(scratch / "b.msh", back);
  EXPECT_EQ(read_file(scratch / "b.msh"), first);
  EXPECT_EQ(message_of<DataError>([&] { write_tet_mesh("/dev/full", mesh); }),
            "/dev/full: cannot be written: No space left on device");
}

TEST(MshFile, ASoftObjectIsFreeAllOverAndNoGel) {
  const ScratchFolder scratch;
  const TetMesh gel = two_tets();
  TetMesh object = gel;
  object.tags.assign(6, BoundaryTag::free);
  write_tet_mesh(scratch / "object.msh", object);
  write_tet_mesh(scratch / "gel.msh", gel);
  const TetMesh back = read_object_tet_mesh(scratch / "object.msh");
  EXPECT_EQ(back.positions, object.positions);
  EXPECT_EQ(back.tets, object.tets);
  EXPECT_EQ(back.faces(BoundaryTag::free), object.boundary);
  EXPECT_TRUE(back.vertices(BoundaryTag::glued).empty());
  EXPECT_EQ(read_msh(scratch / "object.msh").triangle_tags, std::vector<int>(6, 5));
  EXPECT_EQ(message_of<DataError>([&] { read_tet_mesh(scratch / "object.msh"); }),
            (scratch / "object.msh").string() + ": is the mesh of a soft object, expected that of a gel");
  EXPECT_EQ(message_of<DataError>([&] { read_object_tet_mesh(scratch / "gel.msh"); }),
            (scratch / "gel.msh").string() + ": is the mesh of a gel, expected that of a soft object");
}

class BadMsh : public ::testing::Test {
 protected:
  std::string error(const std::string& bytes, bool tagged = false) {
    const std::filesystem::path path = scratch_.file("a.msh", bytes);
    std::string text = message_of<DataError>(
        [&] { tagged ? static_cast<void>(read_tet_mesh(path)) : static_cast<void>(read_msh(path)); });
    const std::string folder = (scratch_ / "").string();
    return text.starts_with(folder) ? text.substr(folder.size()) : text;
  }
  std::string changed(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }
  ScratchFolder scratch_;
};

TEST_F(BadMsh, ContentIsRefusedWithItsPlace) {
  const std::string good = msh22_ascii();
  EXPECT_EQ(error(""), "a.msh: is not a Gmsh file: it begins with '', not with $MeshFormat");
  EXPECT_EQ(error("*NODE, NSET=Nall\n1,2,3\n"),
            "a.msh: is not a Gmsh file: it begins with '*NODE, NSET=Nall' (an Abaqus or CalculiX input?), not with "
            "$MeshFormat");
  EXPECT_EQ(error(changed(good, "2.2 0", "4.0 0")), "a.msh:2: MSH version '4.0' is not supported (2.2 and 4.1 are)");
  EXPECT_EQ(error(good.substr(0, good.size() - 20)),
            "a.msh: section $Elements has no $EndElements (the file is cut off or corrupt)");
  EXPECT_EQ(error(changed(good, "20 0 1 0", "10 0 1 0")), "a.msh:12: node 10 is defined twice");
  EXPECT_EQ(error(changed(good, "20 0 1 0", "20 0 inf 0")), "a.msh: vertex 2 is not finite");
  EXPECT_EQ(error(changed(good, "10 30 20 40", "10 30 20 41")),
            "a.msh:19: a tetrahedron refers to node 41, which is not defined");
  EXPECT_EQ(error(changed(good, "$Nodes\n4", "$Nodes\n4000000000")),
            "a.msh:9: 4000000000 nodes do not fit into the 36 bytes that follow");
  EXPECT_EQ(error(changed(good, "3 4 2 9 1 10 30 20 40", "3 11 2 9 1 1 2 3 4 5 6 7 8 9 10")),
            "a.msh:19: 10-node tetrahedron (element type 11) is not supported (4-node tetrahedra, type 4, are)");
  EXPECT_EQ(error(changed(good, "3 4 2", "3 77 2")),
            "a.msh:19: element type 77 is not supported (4-node tetrahedra, type 4, are)");
  EXPECT_EQ(error(changed(good, "$Elements\n3", "$Elements\n2")), "a.msh: has no tetrahedra");
  EXPECT_EQ(error(changed(msh41_ascii(), "3 1 4 1", "3 1 4 7")),
            "a.msh:28: 7 elements do not fit (1 of 2 elements read)");
}

TEST_F(BadMsh, TaggedMeshMustBeWholeAndPositive) {
  write_tet_mesh(scratch_ / "good.msh", two_tets());
  const std::string good = read_file(scratch_ / "good.msh");
  EXPECT_EQ(error(msh22_ascii(), true), "a.msh: no boundary triangle is tagged front");
  EXPECT_EQ(error(changed(good, "7 1 2 3 4\n", "7 2 1 3 4\n"), true),
            "a.msh: tet 0 has volume -1.67e-10 m^3, must be positive");
  EXPECT_EQ(
      error(changed(good, " 1 3 0\n", " 1 5 0\n"), true),
      "a.msh: boundary triangle 5 near (0.0003333, 0, 0.0003333) m has physical tag 5, expected 1 (front), 2 (side) "
      "or 3 (glued)");
  EXPECT_EQ(error(changed(good, "6 1 2 4\n", "6 1 4 2\n"), true),
            "a.msh: its 6 tagged triangles are not the 6 outward boundary triangles of its tets, each exactly once");
}

TEST(MshFile, RealMeshesHaveTheirKnownCounts) {
  TACIPC_SHARED_DATA(released, "data/tacipc_release/gel/gelslim-gel-l_0.1.msh");
  const MshContent gel = read_msh(released);
  EXPECT_EQ(gel.positions.rows(), 23661);
  EXPECT_EQ(gel.tets.rows(), 104675);
  TACIPC_SHARED_DATA(large, "reference/gel24k.msh");
  EXPECT_EQ(read_msh(large).tets.rows(), 104783);
  TACIPC_SHARED_DATA(small, "reference/gel3k.msh");
  EXPECT_EQ(read_msh(small).positions.rows(), 3113);
  TACIPC_SHARED_DATA(calculix, "data/gsmini_force/ccx_mesh/all.msh");
  EXPECT_EQ(message_of<DataError>([&] { read_msh(calculix); }),
            calculix.string() +
                ": is not a Gmsh file: it begins with '*NODE, NSET=Nall' (an Abaqus or CalculiX input?), not with "
                "$MeshFormat");
}

}  // namespace tet_mesh_test
}  // namespace tacipc
