#include <algorithm>
#include <vector>

#include "common/base/error.h"
#include "common/stage/stage.h"
#include "stages/object/indenter/ball.h"
#include "stages/object/indenter/indenter_config.h"
#include "stages/object/indenter/rounded_field.h"

namespace {

using namespace tacipc;

const StageSpec kIndenter{.name = "indenter",
                          .summary = "Make indenters as printed: balls, and meshes with rounded edges, tip on +z.",
                          .inputs = {{.flag = "--config", .help = "ball or rounding (YAML)"},
                                     {.flag = "--mesh", .help = "mesh to round, its tip on +z", .required = false}}};

TriangleMesh rounded(Stage& stage, const RoundedMesh& wanted) {
  const TriangleMesh mesh = read_triangle_mesh(stage.input("--mesh"), metres_per_unit(wanted.unit));
  // The object's foot is often wider than its tip: parts deeper than the relief must not widen the grid.
  const double cut = mesh.positions.col(2).maxCoeff() - wanted.relief_m;
  TriangleMesh tip = mesh;
  tip.triangles.resize(0, 3);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index t = 0; t < mesh.num_triangles(); ++t) {
    double top = -1e300;
    for (int k = 0; k < 3; ++k) top = std::max(top, mesh.positions(mesh.triangles(t, k), 2));
    if (top > cut) kept.push_back(t);
  }
  tip.triangles = mesh.triangles(kept, Eigen::all);
  std::vector<Eigen::Index> corners(tip.triangles.data(), tip.triangles.data() + tip.triangles.size());
  tip.positions = mesh.positions(corners, Eigen::all);
  for (Eigen::Index i = 0; i < tip.triangles.size(); ++i) tip.triangles.data()[i] = static_cast<int>(i);
  const HeightField field = highest_points(tip, wanted.spacing_m, wanted.edge_radius_m + 2.0 * wanted.spacing_m);
  constexpr double kMaxPoints = 4e6;
  if (static_cast<double>(field.z.size()) > kMaxPoints)
    throw DataError("{}: a spacing of {} mm makes more than {} points", stage.input("--mesh").string(),
                    1e3 * wanted.spacing_m, kMaxPoints);
  const HeightField round =
      rounded(tip, wanted.edge_radius_m, wanted.spacing_m, wanted.edge_radius_m + wanted.spacing_m);
  const double before = *std::ranges::max_element(field.z);
  const double after = *std::ranges::max_element(round.z);
  if (!(after > cut))
    throw DataError("{}: opened with a ball of {} mm, nothing of it remains", stage.input("--mesh").string(),
                    1e3 * wanted.edge_radius_m);
  stage.summarize({{"tip_lowered_mm", 1e3 * (before - after)}});
  return solid(round, wanted.relief_m);
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kIndenter, argc, argv, [](Stage& stage) {
    const bool given = stage.optional_input("--mesh").has_value();
    const auto config = stage.read_config<IndenterConfig>("--config");
    if (given != config.mesh.has_value())
      throw UsageError("--mesh: needed where the configuration rounds one, and only there");
    const TriangleMesh mesh =
        config.mesh ? rounded(stage, *config.mesh) : ball_mesh(*config.ball_radius_m, config.ball_edge_m);
    write_ply(stage.output("object.ply"), mesh);
    stage.summarize({{"vertices", static_cast<int>(mesh.num_vertices())},
                     {"triangles", static_cast<int>(mesh.num_triangles())},
                     {"volume_mm3", 1e9 * signed_volume(mesh)}});
  });
}
