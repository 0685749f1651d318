#include "stages/object/decimate/mesh_doctor.h"

#include <numbers>
#include <random>

#include "common/base/error.h"
#include "stages/object/decimate/self_intersection.h"
#include "stages/object/decimate/surface_topology.h"
#include "tests/scratch_folder.h"
#include "tests/stages/object/decimate/shapes.h"

namespace tacipc {
namespace mesh_doctor_test {

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
      "open mesh: boundary loop of 3 edges, length 34.14 mm near (0, 6.667, 3.333) mm (holes of at most 128 edges "
      "and 3 mm are filled)");
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

/// The edge between two vertices as the cube() of one square a side has them, from its corner at the origin along z.
std::array<int, 2> edge_along_z(const TriangleMesh& cube) {
  std::array<int, 2> edge{-1, -1};
  for (int v = 0; v < 8; ++v) {
    if (cube.positions.row(v).isZero()) edge[0] = v;
    if (cube.positions.row(v) == Eigen::RowVector3d(0, 0, kSize)) edge[1] = v;
  }
  return edge;
}

TEST(MeshDoctor, DropsAFinThatStandsOnAnEdge) {
  const TriangleMesh box = cube(kSize);
  TriangleMesh fin = with_face(box, {0, 1, 8});
  fin.positions.conservativeResize(9, 3);
  fin.positions.row(8) << -kSize, 2 * kSize, 0;
  DoctorReport report;
  const TriangleMesh mesh = treat(fin, report);
  EXPECT_EQ(mesh.positions, box.positions);
  EXPECT_TRUE(is_closed_manifold(mesh));
  EXPECT_NEAR(signed_volume(mesh), std::pow(kSize, 3), 1e-18);
  EXPECT_EQ(report.separated_edges, 1);
  EXPECT_EQ(report.debris_components, 1);
}

TEST(MeshDoctor, TakesSolidsApartThatShareAnEdge) {
  // The second cube is the first one turned half a turn about the edge: faces meet across matter, not across the gap.
  const TriangleMesh box = cube(kSize);
  const auto [low, high] = edge_along_z(box);
  TriangleMesh other = box;
  other.positions.leftCols<2>() *= -1.0;
  TriangleMesh two = joined(box, other);
  for (Eigen::Index i = 0; i < two.triangles.size(); ++i) {
    int& v = two.triangles.data()[i];
    if (v == 8 + low) v = low;
    if (v == 8 + high) v = high;
  }
  DoctorReport report;
  const TriangleMesh mesh = treat(two, report);
  EXPECT_TRUE(is_closed_manifold(mesh));
  EXPECT_EQ(mesh.num_vertices(), 16);
  EXPECT_EQ(mesh.num_triangles(), 24);
  EXPECT_EQ(report.separated_edges, 1);
  EXPECT_EQ(report.components, 2);
  EXPECT_NEAR(signed_volume(mesh), 2.0 * std::pow(kSize, 3), 1e-18);
}

TEST(MeshDoctor, HalvesAnEdgeWhoseSheetsShareBothEnds) {
  // A hollow tetrahedron that touches an edge of the cube from inside along its whole length.
  TriangleMesh box = cube(kSize);
  const auto [low, high] = edge_along_z(box);
  box.positions.conservativeResize(10, 3);
  box.positions.row(8) << 0.6 * kSize, 0.2 * kSize, 0.5 * kSize;
  box.positions.row(9) << 0.2 * kSize, 0.6 * kSize, 0.5 * kSize;
  const auto corner_of = [&](int v) { return Vector3(box.positions.row(v).transpose()); };
  const Vector3 a = corner_of(low), b = corner_of(high), c = corner_of(8), d = corner_of(9);
  const double hollow = std::abs((b - a).dot((c - a).cross(d - a))) / 6.0;
  TriangleMesh both = box;
  const bool right_handed = (b - a).dot((c - a).cross(d - a)) > 0.0;
  for (std::array<int, 3> face : {std::array{low, 8, high}, {low, high, 9}, {low, 9, 8}, {high, 8, 9}}) {
    // Those are outward for b − a, c − a, d − a right-handed; the hollow's look inwards.
    if (right_handed) std::swap(face[1], face[2]);
    both = with_face(both, face);
  }
  DoctorReport report;
  const TriangleMesh mesh = treat(both, report);
  EXPECT_TRUE(is_closed_manifold(mesh));
  EXPECT_EQ(report.separated_edges, 1);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(mesh.num_vertices(), 12) << "two in the middle of the edge";
  EXPECT_NEAR(signed_volume(mesh), std::pow(kSize, 3) - hollow, 1e-18);
}

TEST(MeshDoctor, DropsClosedPartsWithoutVolume) {
  const TriangleMesh ball = sphere(kSize, 3);
  TriangleMesh sheet = cube(kSize, 4);
  sheet.positions.col(2).setConstant(3.0 * kSize);
  DoctorReport report;
  const TriangleMesh mesh = treat(joined(ball, sheet), report);
  EXPECT_EQ(mesh.positions, ball.positions);
  EXPECT_GE(report.flat_components, 1);
}

TEST(MeshDoctor, TakesTheSideThatIsAskedForWhereNothingClosesTheSurface) {
  // An open bowl, its rim up: three quarters of a sphere, no hole that may be filled.
  const TriangleMesh ball = sphere(kSize, 5);
  std::vector<int> lid;
  for (int f = 0; f < static_cast<int>(ball.num_triangles()); ++f) {
    const double z = (corner(ball, f, 0) + corner(ball, f, 1) + corner(ball, f, 2)).z() / 3.0;
    if (z > 0.5 * kSize) lid.push_back(f);
  }
  const TriangleMesh bowl = without_faces(ball, lid);
  EXPECT_TRUE(refusal(bowl).starts_with("open mesh: "));
  DoctorConfig config;
  config.height_field = SideConfig{.side = "-z", .spacing_m = 0.2e-3};
  DoctorReport report;
  const TriangleMesh below = treat(bowl, report, config);
  EXPECT_TRUE(is_closed_manifold(below));
  ASSERT_TRUE(report.height_field);
  EXPECT_TRUE(report.changed_mesh());
  EXPECT_EQ(report.height_field->side, "-z");
  EXPECT_EQ(report.height_field->error.spacing_m, 0.2e-3);
  EXPECT_TRUE(report.height_field->reason.starts_with("open mesh: "));
  // The sagitta of a step, h²/8r, where it is level; about a step at the silhouette.
  EXPECT_LT(report.height_field->error.mean_m, 0.02e-3);
  EXPECT_GT(report.height_field->error.mean_m, 0.0);
  EXPECT_LT(report.height_field->error.max_m, 0.3e-3);
  EXPECT_NEAR(below.positions.col(2).minCoeff(), -kSize, 1e-6);
  EXPECT_GE(below.positions.col(2).maxCoeff(), bowl.positions.col(2).maxCoeff());
  // From its other side the same bowl is hollow; from beside, an arc.
  config.height_field->side = "+z";
  const TriangleMesh above = treat(bowl, report, config);
  EXPECT_TRUE(is_closed_manifold(above));
  EXPECT_LT(signed_volume(above), signed_volume(below));
  config.height_field->side = "-x";
  const TriangleMesh beside = treat(bowl, report, config);
  EXPECT_TRUE(is_closed_manifold(beside));
  EXPECT_NEAR(beside.positions.col(0).minCoeff(), -kSize, 1e-6);
  // What is closed is not touched.
  DoctorReport sound;
  EXPECT_EQ(treat(ball, sound, config).positions, ball.positions);
  EXPECT_FALSE(sound.height_field);
}

TEST(MeshDoctor, MakesPlatesOfOpenPartsOnRequest) {
  // Half of a sphere: a plate along it has the area of its middle surface times the thickness, to second order.
  const TriangleMesh ball = sphere(kSize, 5);
  std::vector<int> lid;
  for (int f = 0; f < static_cast<int>(ball.num_triangles()); ++f)
    if ((corner(ball, f, 0) + corner(ball, f, 1) + corner(ball, f, 2)).z() > 0.0) lid.push_back(f);
  const TriangleMesh bowl = without_faces(ball, lid);
  EXPECT_TRUE(refusal(bowl).starts_with("open mesh: "));
  DoctorConfig config;
  config.sheet_thickness_m = 0.05 * kSize;
  DoctorReport report;
  const TriangleMesh plate = treat(bowl, report, config);
  EXPECT_TRUE(is_closed_manifold(plate));
  EXPECT_EQ(report.thickened_sheets, 1);
  EXPECT_TRUE(report.changed_mesh());
  EXPECT_NEAR(signed_volume(plate) / (surface_area(bowl) * 0.05 * kSize), 1.0, 0.01);
  EXPECT_NEAR(plate.positions.col(2).minCoeff(), -1.025 * kSize, 1e-3 * kSize);
  // A small hole is filled as before, a closed part stays as it is, and vertices that nothing uses do not appear.
  DoctorReport sound;
  EXPECT_EQ(treat(ball, sound, config).positions, ball.positions);
  DoctorReport both;
  const TriangleMesh pair = treat(joined(without_faces(ball, {5}), moved(bowl, {3.0 * kSize, 0.0, 0.0})), both, config);
  EXPECT_TRUE(is_closed_manifold(pair));
  EXPECT_EQ(both.filled_holes, 1);
  EXPECT_EQ(both.thickened_sheets, 1);
  EXPECT_EQ(pair.positions.topRows(ball.num_vertices()), ball.positions);
}

TEST(MeshDoctor, TakesNoSideThatShowsNothing) {
  const TriangleMesh upright =
      make_mesh({{0, 0, 0}, {kSize, 0, 0}, {kSize, 0, kSize}, {0, 0, kSize}}, {{0, 1, 2}, {0, 2, 3}});
  DoctorConfig config;
  config.height_field = SideConfig{.side = "-z"};
  EXPECT_EQ(refusal(upright, config), "nothing wider than 0.05 mm is seen of the mesh from its side -z");
  config.height_field->side = "+y";
  DoctorReport report;
  EXPECT_TRUE(is_closed_manifold(treat(upright, report, config)));
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
  EXPECT_EQ(refusal(cube(2e-5)),
            "the mesh is 0.02 mm wide, expected 0.5 mm to 500 mm; is the unit right? (in m it is 20 mm wide)");
  EXPECT_EQ(refusal(cube(10.0)),
            "the mesh is 1e+04 mm wide, expected 0.5 mm to 500 mm; is the unit right? (in um it is 10 mm wide)");
  EXPECT_EQ(refusal(cube(1e7)), "the mesh is 1e+10 mm wide, expected 0.5 mm to 500 mm; is the unit right?");
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
        case 0: mesh = without_faces(mesh, {face}); break;
        case 1: mesh = with_face_turned(mesh, face); break;
        case 2:
          mesh = with_face(mesh, {mesh.triangles(face, 2), mesh.triangles(face, below(2)), mesh.triangles(face, 1)});
          break;
        case 3: mesh.triangles(face, below(3)) = vertex; break;
        case 4: mesh.positions.row(mesh.triangles(face, 0)) = mesh.positions.row(mesh.triangles(face, 1)); break;
        case 5:
          mesh.positions.row(mesh.triangles(face, 0)) =
              0.5 * (mesh.positions.row(mesh.triangles(face, 1)) + mesh.positions.row(mesh.triangles(face, 2)));
          break;
        case 6: mesh = with_face(mesh, {vertex, mesh.triangles(face, 0), mesh.triangles(face, 1)}); break;
        default: mesh = soup(mesh);
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

}  // namespace mesh_doctor_test
}  // namespace tacipc
