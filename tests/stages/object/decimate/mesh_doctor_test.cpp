#include "stages/object/decimate/mesh_doctor.h"

#include <numbers>
#include <random>

#include "common/base/error.h"
#include "stages/object/decimate/self_intersection.h"
#include "stages/object/decimate/surface_topology.h"
#include "tests/scratch_folder.h"
#include "tests/stages/object/decimate/shapes.h"

namespace tacipc {
namespace {

constexpr double kSize = 0.01;

TriangleMesh treat(const TriangleMesh& mesh, DoctorReport& report, const DoctorConfig& config = {}) {
  return treat_mesh(mesh, config, report);
}

std::string refusal(const TriangleMesh& mesh, const DoctorConfig& config = {}) {
  DoctorReport report;
  return message_of<DataError>([&] { treat_mesh(mesh, config, report); });
}

/// Each face with three vertices of its own.
TriangleMesh soup(const TriangleMesh& mesh, double jitter_m = 0.0) {
  TriangleMesh out;
  out.positions.resize(3 * mesh.num_triangles(), 3);
  out.triangles.resize(mesh.num_triangles(), 3);
  for (int i = 0; i < static_cast<int>(3 * mesh.num_triangles()); ++i) {
    out.positions.row(i) = mesh.positions.row(mesh.triangles(i / 3, i % 3));
    out.positions.row(i).array() += jitter_m * ((i * 7919) % 13 - 6) / 6.0;
    out.triangles(i / 3, i % 3) = i;
  }
  return out;
}

TEST(MeshDoctor, LeavesASoundMeshAsItIs) {
  const TriangleMesh mesh = sphere(kSize, 3);
  DoctorReport report;
  const TriangleMesh same = treat(mesh, report);
  EXPECT_EQ(same.positions, mesh.positions);
  EXPECT_EQ(same.triangles, mesh.triangles);
  EXPECT_FALSE(report.changed_mesh());
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.self_intersections, 0);
}

TEST(MeshDoctor, MergesVerticesOfOpenEdgesExactlyAndWithinTheTolerance) {
  const TriangleMesh ball = sphere(kSize, 2);
  for (const double jitter : {0.0, 2e-9}) {
    DoctorReport report;
    const TriangleMesh mesh = treat(soup(ball, jitter), report);
    EXPECT_TRUE(is_closed_manifold(mesh));
    EXPECT_EQ(mesh.num_vertices(), ball.num_vertices());
    EXPECT_EQ(report.merged_vertices, 3 * ball.num_triangles() - ball.num_vertices());
    EXPECT_EQ(report.unreferenced_vertices, 0);
  }
  EXPECT_NE(refusal(soup(ball, 1e-6)), "") << "a micrometre is not a rounding error";
}

TEST(MeshDoctor, KeepsPartsApartThatOnlyTouch) {
  const TriangleMesh two = joined(cube(kSize), moved(cube(kSize), {kSize, 0, 0}));
  DoctorReport report;
  const TriangleMesh mesh = treat(two, report);
  EXPECT_EQ(mesh.positions, two.positions);
  EXPECT_EQ(report.components, 2);
}

TEST(MeshDoctor, RemovesUnreferencedVerticesAndKeepsTheOrderOfTheOthers) {
  TriangleMesh mesh = cube(kSize);
  Positions more(10, 3);
  more << Eigen::RowVector3d(9, 9, 9), mesh.positions, Eigen::RowVector3d(-9, 0, 0);
  DoctorReport report;
  const TriangleMesh out = treat({more, (mesh.triangles.array() + 1).matrix()}, report);
  EXPECT_EQ(out.positions, mesh.positions);
  EXPECT_EQ(report.unreferenced_vertices, 2);
}

TEST(MeshDoctor, RemovesFacesWithoutArea) {
  // A face that names a vertex twice, and one whose middle corner lies on an edge it shares with the surface.
  DoctorReport named;
  EXPECT_EQ(treat(with_face(cube(kSize), {0, 0, 1}), named).num_triangles(), 12);
  EXPECT_EQ(named.degenerate_faces, 1);

  const TriangleMesh tet = make_mesh({{0, 0, 0}, {kSize, 0, 0}, {0, kSize, 0}, {0, 0, kSize}, {kSize / 2, 0, 0}},
                                     {{0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 1, 4}, {0, 3, 2}, {1, 2, 3}});
  ASSERT_TRUE(is_closed_manifold(tet));
  DoctorReport flipped;
  const TriangleMesh mesh = treat(tet, flipped);
  EXPECT_TRUE(is_closed_manifold(mesh));
  EXPECT_EQ(mesh.num_triangles(), 6);
  EXPECT_EQ(flipped.degenerate_faces, 1);
  EXPECT_NEAR(signed_volume(mesh), kSize * kSize * kSize / 6, 1e-18);
  for (int f = 0; f < 6; ++f) EXPECT_GT(area_vector(mesh, f).norm(), 1e-6);
}

TEST(MeshDoctor, PullsFacesWithTwoCornersAtOnePlaceTogether) {
  // Edge (0, 1) of the tetrahedron split by a vertex 4 at the place of vertex 1, with two faces without area.
  const TriangleMesh tet = make_mesh({{0, 0, 0}, {kSize, 0, 0}, {0, kSize, 0}, {0, 0, kSize}, {kSize, 0, 0}},
                                     {{0, 2, 4}, {4, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  ASSERT_TRUE(is_closed_manifold(tet));
  DoctorReport report;
  const TriangleMesh mesh = treat(tet, report);
  EXPECT_TRUE(is_closed_manifold(mesh));
  EXPECT_EQ(mesh.num_vertices(), 4);
  EXPECT_EQ(report.merged_vertices, 1);
  EXPECT_EQ(report.degenerate_faces, 2);
}

TEST(MeshDoctor, RemovesDuplicateFaces) {
  const TriangleMesh box = cube(kSize);
  DoctorReport twice;
  const TriangleMesh again = with_face(box, {box.triangles(3, 1), box.triangles(3, 2), box.triangles(3, 0)});
  EXPECT_EQ(treat(again, twice).triangles, box.triangles);
  EXPECT_EQ(twice.duplicate_faces, 1);
  // A sheet of two faces back to back inside: no edge needs it.
  const int a = box.triangles(0, 0), b = box.triangles(0, 1);
  int far = 0;
  while ((box.positions.row(far) - box.positions.row(a)).norm() < 1.5 * kSize) ++far;
  DoctorReport sheet;
  TriangleMesh both = with_face(with_face(box, {a, b, far}), {b, a, far});
  EXPECT_EQ(treat(both, sheet).num_triangles(), 12);
  EXPECT_EQ(sheet.duplicate_faces, 2);
}

TEST(MeshDoctor, TurnsFacesOutwards) {
  const TriangleMesh ball = sphere(kSize, 2);
  DoctorReport one;
  EXPECT_NEAR(signed_volume(treat(with_face_turned(ball, 17), one)), signed_volume(ball), 1e-20);
  EXPECT_EQ(one.reoriented_faces, 1);
  TriangleMesh inside_out = ball;
  inside_out.triangles.col(0).swap(inside_out.triangles.col(1));
  DoctorReport all;
  EXPECT_NEAR(signed_volume(treat(inside_out, all)), signed_volume(ball), 1e-20);
  EXPECT_EQ(all.reoriented_faces, ball.num_triangles());
}

TEST(MeshDoctor, RefusesAOneSidedSurface) {
  // A Möbius strip of seven quads.
  std::vector<Vector3> vertices;
  std::vector<std::array<int, 3>> faces;
  constexpr int kTurns = 7;
  for (int i = 0; i < kTurns; ++i) {
    const double u = 2 * std::numbers::pi * i / kTurns;
    for (const double w : {-0.3, 0.3})
      vertices.push_back(kSize * Vector3((1 + w * std::cos(u / 2)) * std::cos(u),
                                         (1 + w * std::cos(u / 2)) * std::sin(u), w * std::sin(u / 2)));
    const int a = 2 * i, b = 2 * i + 1;
    const bool last = i == kTurns - 1;
    const int c = last ? 0 : b + 2, d = last ? 1 : a + 2;
    faces.push_back({a, b, c});
    faces.push_back({a, c, d});
  }
  EXPECT_EQ(refusal(make_mesh(vertices, faces)).substr(0, 37), "one-sided surface: the faces around (");
}

TEST(MeshDoctor, FillsSmallHolesAndRefusesLargeOnes) {
  const TriangleMesh ball = sphere(kSize, 4);
  DoctorReport report;
  const TriangleMesh mesh = treat(without_faces(ball, {5, 300}), report);
  EXPECT_TRUE(is_closed_manifold(mesh));
  EXPECT_EQ(report.filled_holes, 2);
  EXPECT_EQ(report.hole_faces, 2);
  EXPECT_NEAR(signed_volume(mesh), signed_volume(ball), 1e-18);

  EXPECT_EQ(
      refusal(without_faces(cube(kSize), {0})),
      "open mesh: boundary loop of 3 edges, length 34.14 mm near (0, 6.667, 3.333) mm (holes of at most 64 edges and "
      "2 mm are filled)");
  DoctorConfig generous;
  generous.relative_max_hole_length = 10;
  DoctorReport filled;
  EXPECT_TRUE(is_closed_manifold(treat(without_faces(cube(kSize), {0, 1}), filled, generous)));
  EXPECT_EQ(filled.hole_faces, 2);
  DoctorConfig none;
  none.max_hole_edges = 0;
  EXPECT_EQ(refusal(without_faces(ball, {5}), none).substr(0, 44), "open mesh: boundary loop of 3 edges, length ");
}

TEST(MeshDoctor, ClosesACrackOfNoWidth) {
  // The long edge 0 1 of one face meets two short ones of its neighbours: a T-junction.
  const TriangleMesh tet = make_mesh({{0, 0, 0}, {kSize, 0, 0}, {0, kSize, 0}, {0, 0, kSize}, {kSize / 2, 0, 0}},
                                     {{0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  DoctorConfig generous;
  generous.relative_max_hole_length = 10;
  DoctorReport report;
  const TriangleMesh mesh = treat(tet, report, generous);
  EXPECT_TRUE(is_closed_manifold(mesh));
  EXPECT_EQ(mesh.num_triangles(), 6);
  for (int f = 0; f < 6; ++f) EXPECT_GT(area_vector(mesh, f).norm(), 1e-6);
}

TEST(MeshDoctor, SplitsAVertexWhereTwoSheetsMeet) {
  // Two cubes that share one corner by index.
  TriangleMesh two = joined(cube(kSize), moved(cube(kSize), {kSize, kSize, kSize}));
  int low = -1, high = -1;
  for (int v = 0; v < 16; ++v) {
    if (v < 8 && two.positions.row(v).minCoeff() == kSize) low = v;
    if (v >= 8 && two.positions.row(v).maxCoeff() == kSize) high = v;
  }
  for (Eigen::Index i = 0; i < two.triangles.size(); ++i)
    if (two.triangles.data()[i] == high) two.triangles.data()[i] = low;
  DoctorReport report;
  const TriangleMesh mesh = treat(two, report);
  EXPECT_TRUE(is_closed_manifold(mesh));
  EXPECT_EQ(report.split_vertices, 1);
  EXPECT_EQ(mesh.num_vertices(), 16);
  EXPECT_EQ(report.overlapping_components, 0) << "touching in a point is not a crossing";
}

TEST(MeshDoctor, RefusesAnEdgeOfMoreThanTwoFaces) {
  const TriangleMesh box = cube(kSize);
  TriangleMesh fin = with_face(box, {0, 1, 8});
  fin.positions.conservativeResize(9, 3);
  fin.positions.row(8) << -kSize, 2 * kSize, 0;
  EXPECT_EQ(refusal(fin), "non-manifold mesh: 3 faces share the edge near (0, 5, 0) mm");
}

TEST(MeshDoctor, RemovesDebris) {
  const TriangleMesh ball = sphere(kSize, 3);
  DoctorReport report;
  const TriangleMesh speck = moved(sphere(kSize / 500, 1), {2 * kSize, 0, 0});
  const TriangleMesh flap = make_mesh({{0, 0, 2 * kSize}, {kSize, 0, 2 * kSize}, {0, kSize, 2 * kSize}}, {{0, 1, 2}});
  const TriangleMesh mesh = treat(joined(joined(speck, ball), flap), report);
  EXPECT_EQ(report.debris_components, 2);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(mesh.positions, ball.positions);
  EXPECT_EQ(mesh.triangles, ball.triangles);
}

TEST(MeshDoctor, DropsWhatLiesInsideAndKeepsWhatOverlaps) {
  DoctorReport inside;
  EXPECT_EQ(treat(joined(sphere(kSize, 2), sphere(kSize / 3, 2)), inside).num_triangles(), 128);
  EXPECT_EQ(inside.hidden_components, 1);
  EXPECT_EQ(inside.components, 1);
  DoctorReport apart;
  EXPECT_EQ(treat(joined(sphere(kSize, 2), moved(sphere(kSize / 3, 2), {2 * kSize, 0, 0})), apart).num_triangles(),
            256);
  EXPECT_EQ(apart.components, 2);
  EXPECT_EQ(apart.overlapping_components, 0);
  DoctorReport across;
  EXPECT_EQ(treat(joined(sphere(kSize, 2), moved(sphere(kSize / 3, 2), {kSize, 0, 0})), across).num_triangles(), 256);
  EXPECT_EQ(across.overlapping_components, 1);
  EXPECT_EQ(across.self_intersections, 0);
}

TEST(MeshDoctor, CountsOrRefusesSelfIntersections) {
  TriangleMesh box = cube(kSize, 4);
  // A vertex of the top pulled through the bottom.
  for (int v = 0; v < static_cast<int>(box.num_vertices()); ++v)
    if (box.positions.row(v).isApprox(Eigen::RowVector3d(kSize / 2, kSize / 2, kSize)))
      box.positions(v, 2) = -kSize / 4;
  DoctorReport report;
  EXPECT_EQ(treat(box, report).positions, box.positions);
  EXPECT_GT(report.self_intersections, 0);
  DoctorConfig strict;
  strict.refuse_self_intersections = true;
  EXPECT_EQ(refusal(box, strict), "the surface crosses itself: " + std::to_string(report.self_intersections) +
                                      " pairs of faces of one part intersect");
}

TEST(MeshDoctor, RefusesAWrongScale) {
  EXPECT_EQ(refusal(cube(2e-5)), "the mesh is 0.02 mm wide, expected 0.5 mm to 500 mm; is the unit right?");
  EXPECT_EQ(refusal(cube(10.0)), "the mesh is 1e+04 mm wide, expected 0.5 mm to 500 mm; is the unit right?");
  EXPECT_EQ(refusal(make_mesh({{0, 0, 0}, {0, 0, kSize}}, {{0, 0, 1}})), "the mesh has no face with an area");
}

TEST(MeshDoctor, RefusesAClosedSheet) {
  const TriangleMesh sheet = make_mesh({{0, 0, 0}, {kSize, 0, 0}, {kSize, kSize, 0}, {0, kSize, 0}},
                                       {{0, 1, 2}, {0, 2, 3}, {1, 0, 3}, {1, 3, 2}});
  EXPECT_EQ(refusal(sheet), "a closed part of 4 faces near (0, 0, 0) mm encloses no volume (0 mm^3)");
}

TEST(MeshDoctor, HealsOrRefusesWhateverIsDoneToAMesh) {
  std::mt19937 random(7);
  const auto below = [&](Eigen::Index n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  DoctorConfig generous;
  generous.relative_max_hole_length = 10;
  int healed = 0, refused = 0;
  for (int round = 0; round < 600; ++round) {
    TriangleMesh mesh =
        round % 2 == 0 ? sphere(kSize, 2) : joined(cube(kSize, 3), moved(sphere(kSize, 1), {kSize, 0, 0}));
    for (int wound = 1 + below(4); wound > 0; --wound) {
      const int face = below(mesh.num_triangles()), vertex = below(mesh.num_vertices());
      switch (below(8)) {
        case 0:
          mesh = without_faces(mesh, {face});
          break;
        case 1:
          mesh = with_face_turned(mesh, face);
          break;
        case 2:
          mesh = with_face(mesh, {mesh.triangles(face, 2), mesh.triangles(face, below(2)), mesh.triangles(face, 1)});
          break;
        case 3:
          mesh.triangles(face, below(3)) = vertex;
          break;
        case 4:
          mesh.positions.row(mesh.triangles(face, 0)) = mesh.positions.row(mesh.triangles(face, 1));
          break;
        case 5:
          mesh.positions.row(mesh.triangles(face, 0)) =
              0.5 * (mesh.positions.row(mesh.triangles(face, 1)) + mesh.positions.row(mesh.triangles(face, 2)));
          break;
        case 6:
          mesh = with_face(mesh, {vertex, mesh.triangles(face, 0), mesh.triangles(face, 1)});
          break;
        default:
          mesh = soup(mesh);
      }
    }
    DoctorReport report;
    try {
      const TriangleMesh out = treat_mesh(mesh, generous, report);
      EXPECT_TRUE(is_closed_manifold(out)) << "round " << round;
      EXPECT_GT(signed_volume(out), 0.0) << "round " << round;
      ++healed;
    } catch (const DataError& error) {
      EXPECT_NE(std::string(error.what()), "");
      ++refused;
    }
  }
  EXPECT_GT(healed, 300);
  EXPECT_GT(refused, 30);
}

TEST(SelfIntersection, FindsExactlyTheCrossingPairs) {
  const TriangleMesh mesh =
      make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, -1}, {0.2, 0.2, 1}, {2, 2, 1}, {0, 0, 1}},
                {{0, 1, 2}, {3, 4, 5}, {0, 1, 6}, {1, 2, 5}});
  EXPECT_EQ(self_intersections(mesh), (std::vector<FacePair>{{0, 1}, {1, 3}}));
}

}  // namespace
}  // namespace tacipc
