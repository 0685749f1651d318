#include "common/mesh/triangle_mesh.h"

#include <Eigen/Geometry>

#include "common/base/error.h"
#include "tests/common/sample_files.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace triangle_mesh_test {

Positions tet_positions(double scale) {
  Positions positions(4, 3);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j) positions(i, j) = scale * kTetPoints[i][j];
  return positions;
}

Triangles tet_triangles() {
  Triangles triangles(4, 3);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j) triangles(i, j) = kTetFaces[i][j];
  return triangles;
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f) {
    const Vector3 a = mesh.positions.row(mesh.triangles(f, 0)), b = mesh.positions.row(mesh.triangles(f, 1)),
                  c = mesh.positions.row(mesh.triangles(f, 2));
    sum += 0.5 * (b - a).cross(c - a).norm();
  }
  return sum;
}

class TriangleMeshFile : public ::testing::Test {
 protected:
  TriangleMesh read(const std::string& name, const std::string& bytes, double scale = 1.0) {
    return read_triangle_mesh(scratch_.file(name, bytes), scale);
  }
  /// Error without the folder.
  std::string error(const std::string& name, const std::string& bytes) {
    std::string text = message_of<DataError>([&] { read(name, bytes); });
    const std::string folder = (scratch_ / "").string();
    if (text.starts_with(folder)) text = text.substr(folder.size());
    return text;
  }
  ScratchFolder scratch_;
};

TEST_F(TriangleMeshFile, EveryFormatGivesTheSameTetrahedron) {
  const std::vector<std::pair<std::string, std::string>> files{{"a.obj", tetrahedron_obj()},
                                                               {"a.OFF", tetrahedron_off()},
                                                               {"a.ply", tetrahedron_ply("ascii")},
                                                               {"b.ply", tetrahedron_ply("binary_little_endian")},
                                                               {"c.ply", tetrahedron_ply("binary_big_endian")}};
  for (const auto& [name, bytes] : files) {
    const TriangleMesh mesh = read(name, bytes, 1e-3);
    EXPECT_EQ(mesh.positions, tet_positions(1e-3)) << name;
    EXPECT_EQ(mesh.triangles, tet_triangles()) << name;
  }
}

/// ASCII as UTF-16, or with more zeros as UTF-32, of either order.
std::string widened(const std::string& text, std::size_t zeros, bool big) {
  std::string wide;
  for (const char c : text) {
    if (big) wide.append(zeros, '\0');
    wide += c;
    if (!big) wide.append(zeros, '\0');
  }
  return wide;
}

TEST_F(TriangleMeshFile, ByteOrderMarksOfUtf8AreReadAndOtherEncodingsRefusedByName) {
  for (const auto& [name, text] :
       std::vector<std::pair<std::string, std::string>>{{"a.obj", tetrahedron_obj()},
                                                        {"a.off", tetrahedron_off()},
                                                        {"a.stl", tetrahedron_ascii_stl()},
                                                        {"a.ply", tetrahedron_ply("ascii")}}) {
    const TriangleMesh plain = read(name, text);
    const TriangleMesh marked = read(name, "\xEF\xBB\xBF" + text);
    EXPECT_EQ(marked.positions, plain.positions) << name;
    EXPECT_EQ(marked.triangles, plain.triangles) << name;
    for (const std::string& mark : {std::string("\xFF\xFE"), std::string()})
      EXPECT_EQ(error(name, mark + widened(text, 1, false)),
                name + ": is UTF-16 (little-endian) text; save it as UTF-8");
    for (const std::string& mark : {std::string("\xFE\xFF"), std::string()})
      EXPECT_EQ(error(name, mark + widened(text, 1, true)), name + ": is UTF-16 (big-endian) text; save it as UTF-8");
    EXPECT_EQ(error(name, std::string("\xFF\xFE\0\0", 4) + widened(text, 3, false)),
              name + ": is UTF-32 text; save it as UTF-8");
    EXPECT_EQ(error(name, std::string("\0\0\xFE\xFF", 4) + widened(text, 3, true)),
              name + ": is UTF-32 text; save it as UTF-8");
  }
  EXPECT_EQ(error("a.obj", "\xEF\xBB\xBFv 0 0 zero\n"), "a.obj:1: z 'zero' is not a number");
  // Whatever a binary STL has in its header, its size tells what it is.
  for (const std::string header : {"\xFF\xFE", "\xFE\xFF", "\xEF\xBB\xBFsolid"})
    EXPECT_EQ(read("a.stl", tetrahedron_binary_stl(header)).num_triangles(), 4);
}

TEST_F(TriangleMeshFile, StlCornersOfEqualCoordinatesBecomeOneVertexInOrderOfAppearance) {
  for (const std::string& bytes :
       {tetrahedron_ascii_stl(), tetrahedron_binary_stl(), tetrahedron_binary_stl("no such word")}) {
    const TriangleMesh mesh = read("a.STL", bytes, 0.0254);
    ASSERT_EQ(mesh.num_vertices(), 4);
    EXPECT_EQ(mesh.num_triangles(), 4);
    EXPECT_EQ(mesh.positions.row(1), tet_positions(0.0254).row(2));
    EXPECT_EQ(mesh.triangles.row(1), (Eigen::RowVector3i(0, 2, 3)));
  }
}

TEST_F(TriangleMeshFile, ObjTakesEveryWayToNameACorner) {
  const std::string vertices = "v 0 0 0 1 0 0\r\nv 1 0 0\r\nv 0 1 0 1.0\r\nvt 0 0\r\nvn 0 0 1\r\n";
  for (const std::string face : {"f 1 2 3", "f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/1/1 3/1/1", "f -3 -2 -1",
                                 "f 1 \\\r\n2 \\ \r\n 3", "f 1 2 3 # the last"}) {
    const TriangleMesh mesh = read("a.obj", vertices + "\r\n  " + face);
    EXPECT_EQ(mesh.triangles, Eigen::RowVector3i(0, 1, 2)) << face;
  }
}

TEST_F(TriangleMeshFile, ConvexPolygonsBecomeFansAndConcaveOnesAreClipped) {
  EXPECT_EQ(read("quad.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n").triangles,
            (Triangles(2, 3) << 0, 1, 2, 0, 2, 3).finished());
  // An arrow head: a fan from corner 0 would cover the notch, so areas tell.
  const TriangleMesh arrow = read("arrow.off", "OFF\n4 1 0\n0 0 2\n-1 0 0\n0 0 1\n1 0 0\n4 3 0 1 2");
  EXPECT_NEAR(area(arrow), 1.0, 1e-15);
  const TriangleMesh comb =
      read("comb.obj", "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 3 2 0\nv 3 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6 7 8\n");
  EXPECT_EQ(comb.num_triangles(), 6);
  EXPECT_NEAR(area(comb), 6.0, 1e-14);
  Vector3 sum = Vector3::Zero();
  for (Eigen::Index f = 0; f < 6; ++f) {
    const Vector3 a = comb.positions.row(comb.triangles(f, 0)), b = comb.positions.row(comb.triangles(f, 1)),
                  c = comb.positions.row(comb.triangles(f, 2));
    sum += (b - a).cross(c - a);
  }
  EXPECT_NEAR(sum.z(), 12.0, 1e-14) << "all triangles look the same way";
}

TEST_F(TriangleMeshFile, PlyComesBackBitByBit) {
  TriangleMesh mesh{tet_positions(1.0 / 3.0), tet_triangles()};
  mesh.positions(2, 1) = -1e-300;
  write_ply(scratch_ / "a.ply", mesh);
  const TriangleMesh back = read_triangle_mesh(scratch_ / "a.ply", 1.0);
  EXPECT_EQ(back.positions, mesh.positions);
  EXPECT_EQ(back.triangles, mesh.triangles);
  const std::string full = message_of<DataError>([&] { write_ply("/dev/full", mesh); });
  EXPECT_EQ(full, "/dev/full: cannot be written: No space left on device");
}

TEST_F(TriangleMeshFile, DamagedStlIsRefused) {
  const std::string whole = tetrahedron_binary_stl("binary");
  EXPECT_EQ(error("a.stl", whole.substr(0, 200)), "a.stl: a binary STL of 4 facets takes 284 bytes, the file has 200");
  EXPECT_EQ(error("a.stl", tetrahedron_binary_stl("solid x" + std::string(1, '\0')).substr(0, 283)),
            "a.stl: a binary STL of 4 facets takes 284 bytes, the file has 283");
  EXPECT_EQ(error("a.stl", whole.substr(0, 82)),
            "a.stl: the file ends inside the facet count of a binary STL at byte 80");
  EXPECT_EQ(error("a.stl", ""), "a.stl: the file is empty");
  EXPECT_EQ(error("a.stl", "solid nothing\nendsolid nothing\n"), "a.stl: has no triangles");
  EXPECT_EQ(error("a.stl", std::string(80, 'b') + std::string(4, '\0')), "a.stl: has no triangles");
  const std::string text = tetrahedron_ascii_stl();
  EXPECT_EQ(error("a.stl", text.substr(0, text.size() - 9)), "a.stl:29: the file ends inside a solid");
  EXPECT_EQ(error("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n"),
            "a.stl:4: z 'zero' is not a number");
  EXPECT_EQ(error("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nendloop\n"),
            "a.stl:4: expected 'vertex', found 'endloop'");
  EXPECT_EQ(error("a.stl", "solid\ncube\n"), "a.stl:2: expected 'facet' or 'endsolid', found 'cube'");
}

TEST_F(TriangleMeshFile, NotFiniteIsRefusedByVertex) {
  EXPECT_EQ(error("a.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n"), "a.obj: vertex 1 is not finite");
  EXPECT_EQ(error("a.off", "OFF 3 1 0\n0 0 0\n0 1 0\n1e999 0 0\n3 0 1 2\n"), "a.off: vertex 2 is not finite");
  std::string stl = tetrahedron_binary_stl("b");
  Bytes nan;
  nan.add(std::numeric_limits<float>::quiet_NaN());
  stl.replace(84 + 12, 4, nan.text);
  EXPECT_EQ(error("a.stl", stl), "a.stl: vertex 0 is not finite");
}

TEST_F(TriangleMeshFile, WrongIndicesAreRefusedWithTheirLine) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(error("a.obj", v + "f 1 2 4\n"),
            "a.obj:4: face refers to vertex 3 (counted from 0), but there are 3 vertices");
  EXPECT_EQ(error("a.obj", v + "f 1 2 0\n"), "a.obj:4: vertex index 0 (OBJ counts from 1)");
  EXPECT_EQ(error("a.obj", v + "f 1 2 -4\n"), "a.obj:4: vertex index -4, but only 3 vertices came before");
  EXPECT_EQ(error("a.obj", v + "f 1 2 99999999999\n"), "a.obj:4: vertex index 99999999999 is too large");
  EXPECT_EQ(error("a.obj", v + "f 1 2\n"), "a.obj:4: face has 2 corners, needs at least 3");
  EXPECT_EQ(error("a.obj", v + "f 1/x 2 3\n"), "a.obj:4: texture or normal index 'x' is not an integer");
  EXPECT_EQ(error("a.obj", v + "f 1/1/1/1 2 3\n"), "a.obj:4: '1/1/1/1' is not a face corner");
  EXPECT_EQ(error("a.obj", v + "face 1 2 3\n"), "a.obj:4: 'face' is not an OBJ statement");
  EXPECT_EQ(error("a.obj", "v 1 2\n"), "a.obj:1: z is missing");
  EXPECT_EQ(error("a.obj", v), "a.obj: has no triangles");
  EXPECT_EQ(error("a.off", "OFF\n3 1 0\n0 0 0\n0 1 0\n1 0 0\n3 0 1 3\n"),
            "a.off:6: face refers to vertex 3 (counted from 0), but there are 3 vertices");
}

TEST_F(TriangleMeshFile, AbsurdCountsAreRefusedBeforeAnythingIsAllocated) {
  EXPECT_EQ(error("a.off", "OFF\n4000000000 1 0\n0 0 0\n"),
            "a.off:2: vertex count 4000000000 does not fit into the 10 bytes that follow");
  EXPECT_EQ(error("a.off", "OFF\n3 -1 0\n0 0 0\n0 0 0\n0 0 0\n"), "a.off:2: face count -1 is negative");
  EXPECT_EQ(error("a.off", "OFF\n3 1 0\n0 0 0\n0 1 0\n1 0 0\n4000000000 0 1 2\n"),
            "a.off:6: corner count 4000000000 does not fit the line");
  std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n";
  EXPECT_EQ(error("a.ply", header + "0123"), fmt::format("a.ply: 4000000000 elements 'vertex' do not fit into the 4 "
                                                         "bytes that follow at byte {}",
                                                         header.size()));
}

TEST_F(TriangleMeshFile, PlyFaultsAreNamed) {
  EXPECT_EQ(error("a.ply", "plywood\n"), "a.ply: the file ends inside the PLY header");
  EXPECT_EQ(error("a.ply", "plywood\nend_header\n"), "a.ply:1: expected 'ply'");
  EXPECT_EQ(error("a.ply", "ply\nelement vertex 0\nend_header\n"), "a.ply:2: the PLY header has no format line");
  EXPECT_EQ(error("a.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty real x\nend_header\n"),
            "a.ply:4: 'real' is not a PLY number type");
  EXPECT_EQ(error("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"),
            "a.ply:6: the vertices have no x, y and z");
  const std::string whole = tetrahedron_ply("binary_big_endian");
  EXPECT_EQ(error("a.ply", whole.substr(0, whole.size() - 2)),
            fmt::format("a.ply: the file ends inside material at byte {}", whole.size() - 4));
  EXPECT_EQ(error("a.xyz", "1 2 3"), "a.xyz: '.xyz' is not a known mesh suffix (.stl, .obj, .off, .ply)");
}

TEST(SignedVolume, IsThatOfTheSolidWhereverItLies) {
  TriangleMesh mesh{tet_positions(1e-3), tet_triangles()};  // three edges of 1 mm at right angles
  EXPECT_NEAR(signed_volume(mesh), 1e-9 / 6, 1e-24);
  mesh.positions.rowwise() += Eigen::RowVector3d(0.02, -0.03, 0.05);
  EXPECT_NEAR(signed_volume(mesh), 1e-9 / 6, 1e-20);
  mesh.triangles.col(0).swap(mesh.triangles.col(1));
  EXPECT_NEAR(signed_volume(mesh), -1e-9 / 6, 1e-20) << "inside out";
  EXPECT_EQ(signed_volume({}), 0.0);
}

TEST(Units, AreMetresPerUnit) {
  EXPECT_EQ(metres_per_unit("mm"), 1e-3);
  EXPECT_EQ(metres_per_unit("um"), 1e-6);
  EXPECT_EQ(message_of<UsageError>([] { metres_per_unit("feet"); }), "'feet' is not a known unit (m, cm, mm, um, in)");
}

}  // namespace triangle_mesh_test
}  // namespace tacipc
