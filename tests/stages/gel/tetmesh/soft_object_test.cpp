// A soft object from its surface: the unit, and the program.
#include "stages/gel/tetmesh/soft_object.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <Eigen/LU>

#include "common/base/error.h"
#include "common/base/files.h"
#include "stages/gel/tetmesh/mesh_check.h"
#include "tests/make_mesh.h"
#include "tests/program_test.h"
#include "tests/stages/gel/tetmesh/gels.h"

namespace tacipc {
namespace soft_object_test {

using ::testing::HasSubstr;

GenerateConfig uniform(double edge_m) {
  GenerateConfig config = preset("uniform_0500um");
  config.sizing.centre_m = config.sizing.inner_m = config.sizing.rim_m = config.sizing.back_m = edge_m;
  return config;
}

TriangleMesh l_shape() {
  TriangleMesh mesh = make_l_shape();
  mesh.positions *= 5e-3;
  return mesh;
}

TEST(SoftObject, IsFilledInsideASurfaceThatStaysAsItIs) {
  const TriangleMesh surface = sphere(5e-3, 3);
  Eigen::Index before = 0;
  for (const double edge_m : {2e-3, 1e-3}) {
    const TetMesh ball = mesh_object(surface, uniform(edge_m));
    check_body(ball, 2.0, "ball");
    EXPECT_EQ(ball.positions.topRows(surface.num_vertices()), surface.positions);
    EXPECT_EQ(ball.boundary, surface.triangles);
    EXPECT_EQ(ball.faces(BoundaryTag::free), surface.triangles);
    EXPECT_TRUE(ball.vertices(BoundaryTag::glued).empty());
    EXPECT_NEAR(volume_of(ball), signed_volume(surface), 1e-12 * volume_of(ball));
    // New vertices lie inside, the more the finer.
    const auto added = ball.positions.bottomRows(ball.num_vertices() - surface.num_vertices());
    EXPECT_GT(added.rows(), before);
    before = added.rows();
    EXPECT_LT(added.rowwise().norm().maxCoeff(), 5e-3);
  }
  EXPECT_GT(before, 300);
}

TEST(SoftObject, NeedNotBeConvexAndMayHaveVerticesThatNoTriangleNames) {
  const TriangleMesh surface = l_shape();
  TriangleMesh more = surface;
  more.positions.conservativeResize(surface.num_vertices() + 1, 3);
  more.positions.row(surface.num_vertices()) << 1, 1, 1;
  const TetMesh one = mesh_object(surface, uniform(2e-3)), other = mesh_object(more, uniform(2e-3));
  EXPECT_NEAR(volume_of(one), 4 * 125e-9, 1e-18);
  EXPECT_EQ(one.positions, other.positions);
  EXPECT_EQ(one.tets, other.tets);
}

TEST(SoftObject, SaysWhatIsWrongWithASurface) {
  const auto refused = [](const TriangleMesh& surface) {
    return message_of<DataError>([&] { mesh_object(surface, uniform(2e-3)); });
  };
  const TriangleMesh box = make_box({0, 0, 0}, {0.01, 0.01, 0.01});
  TriangleMesh open = box, inward = box, flipped = box;
  open.triangles.conservativeResize(11, 3);
  EXPECT_EQ(refused(open), "the surface is open: only one triangle has the edge of vertices 3 and 7");
  inward.triangles.col(0).swap(inward.triangles.col(1));
  EXPECT_EQ(refused(inward), "the triangles look inwards, or enclose no volume");
  std::swap(flipped.triangles(3, 0), flipped.triangles(3, 1));
  EXPECT_THAT(refused(flipped), HasSubstr("two that look opposite ways, meet at the edge of vertices"));
  const auto with = [&](const TriangleMesh& second) {
    TriangleMesh both{Positions(16, 3), Triangles(24, 3)};
    both.positions << box.positions, second.positions;
    both.triangles << box.triangles, second.triangles.array() + 8;
    return both;
  };
  EXPECT_EQ(refused(with(make_box({0.02, 0, 0}, {0.03, 0.01, 0.01}))),
            "the surface is in 2 pieces: a soft object is one solid without cavities");
  // A ball with a thorn inwards that comes out on the other side.
  TriangleMesh crossed = sphere(5e-3, 2);
  crossed.positions.row(0) = Eigen::RowVector3d(-6e-3, 3e-4, 2e-4);
  EXPECT_THAT(refused(crossed), HasSubstr("the surface intersects itself: its triangles "));
  // An L whose two legs lie on each other.
  TriangleMesh folded = l_shape();
  for (const int v : {1, 2, 7, 8}) folded.positions(v, 0) = -5e-3;
  EXPECT_THAT(refused(folded), HasSubstr("cross or lie on each other"));
}

TEST(SoftObject, IsRefusedWhereItWouldBeTooManyVerticesOrIsGradedAsAGel) {
  GenerateConfig config = uniform(1e-3);
  config.max_vertices = 200;
  EXPECT_EQ(message_of<DataError>([&] { mesh_object(sphere(5e-3, 2), config); }),
            "the sizing asks for about 741 vertices, more than max_vertices 200");
  EXPECT_EQ(message_of<UsageError>([&] { mesh_object(sphere(5e-3, 2), preset("tiny")); }),
            "the sizing of an object has uniform_mm alone: edges are not graded as in a gel");
}

class SoftObjectStageTest : public ProgramTest {
 protected:
  int run(const std::string& more, const std::string& config = config_path("gels/uniform_0500um.yaml")) {
    return run_command(fmt::format("{}/tetmesh --log-level warning --config {} --out {} {}", TACIPC_BIN_DIR, config,
                                   (scratch_ / "out").string(), more));
  }
  std::string written(const TriangleMesh& surface) {
    write_ply(scratch_ / "object.ply", surface);
    return "--object " + (scratch_ / "object.ply").string();
  }
};

TEST_F(SoftObjectStageTest, WritesTheObjectAndItsNumbersTheSameAtAnyThreadCount) {
  const TriangleMesh surface = sphere(3e-3, 3);
  const std::string object = written(surface);
  ASSERT_EQ(run(object + " --threads 1"), 0) << said_;
  EXPECT_EQ(said_, "");
  const std::string mesh = read_file(scratch_ / "out/object.msh"), record = read_file(scratch_ / "out/tetmesh.yaml");
  ASSERT_EQ(run(object + " --threads 3"), 0) << said_;
  EXPECT_EQ(read_file(scratch_ / "out/object.msh"), mesh);
  EXPECT_EQ(read_file(scratch_ / "out/tetmesh.yaml"), record);
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/gel.msh"));
  const TetMesh ball = read_object_tet_mesh(scratch_ / "out/object.msh");
  EXPECT_EQ(ball.boundary, surface.triangles);
  EXPECT_THAT(record, HasSubstr(fmt::format("summary:\n  vertices: {}\n  tets: {}\n  free:\n    vertices: {}\n",
                                            ball.num_vertices(), ball.num_tets(), surface.num_vertices())));
  EXPECT_THAT(record, HasSubstr(fmt::format("volume_mm3: {:.4g}\n", 1e9 * volume_of(ball))));
}

TEST_F(SoftObjectStageTest, SaysWhichFilesAreAtFault) {
  TriangleMesh open = sphere(3e-3, 2);
  open.triangles.conservativeResize(open.num_triangles() - 1, 3);
  EXPECT_EQ(run(written(open)), 1);
  EXPECT_THAT(said_, HasSubstr("gels/uniform_0500um.yaml with the surface of "));
  EXPECT_THAT(said_, HasSubstr("object.ply: the surface is open: only one triangle has the edge of vertices "));
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/tetmesh.yaml"));
}

TEST_F(SoftObjectStageTest, FlagsMustAgree) {
  const std::string object = written(sphere(3e-3, 2)),
                    sensor = " --sensor " + config_path("sensors/mctac.yaml").string();
  for (const std::string& flags : {std::string(), object + sensor}) {
    EXPECT_EQ(run(flags), 2);
    EXPECT_THAT(said_, HasSubstr("give --sensor to mesh its gel, or --object to mesh a soft object"));
  }
  EXPECT_EQ(run(object, config_path("gels/import_paper.yaml")), 2);
  EXPECT_THAT(said_, HasSubstr("--object needs a --config with kind: generate"));
  EXPECT_EQ(run(object + " --import " + (scratch_ / "object.ply").string()), 2);
  EXPECT_THAT(said_, HasSubstr("and no --import: only a gel can be imported"));
  EXPECT_EQ(run(object, config_path("gels/tiny.yaml")), 2);
  EXPECT_THAT(said_, HasSubstr("the sizing of an object has uniform_mm alone"));
}

}  // namespace soft_object_test
}  // namespace tacipc
