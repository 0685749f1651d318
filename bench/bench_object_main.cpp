// Writes one of the shapes of verification cases as a mesh, for programs that take files.
#include "common/mesh/triangle_mesh.h"
#include "common/stage/stage.h"
#include "verification/object_shapes.h"

using namespace tacipc;

namespace {

const StageSpec kObject{.name = "bench_object",
                        .summary = "Write a shape (sphere, punch, cone …) as a closed triangle mesh.",
                        .inputs = {{"--config", "the shape, as verification cases give it (YAML)"}}};

struct Shape {
  verify::ObjectShape shape;
  static Shape read(ConfigReader& in) { return {verify::ObjectShape::read(in)}; }
};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kObject, argc, argv, [](Stage& stage) {
    const TriangleMesh mesh = verify::make_object(stage.read_config<Shape>("--config").shape, {});
    write_ply(stage.output("object.ply"), mesh);
    stage.summarize({{"vertices", mesh.num_vertices()}, {"triangles", mesh.num_triangles()}});
  });
}
