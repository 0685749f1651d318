#include <fmt/core.h>

#include "common/base/files.h"
#include "common/stage/stage.h"
#include "stages/gel/export/frame_grids.h"
#include "stages/gel/export/gltf.h"
#include "stages/gel/export/open_press.h"

namespace {

const tacipc::StageSpec kExport{
    .name = "export",
    .summary = "Write the frames of a press as VTK files for ParaView, and as one binary glTF file for Blender.",
    .inputs = {{.flag = "--press", .help = "folder that press wrote"},
               {.flag = "--gel", .help = "gel.msh of tetmesh, the one that was pressed"},
               {.flag = "--object", .help = "object.ply of decimate, the one that was pressed"}}};

}  // namespace

int main(int argc, char** argv) {
  using namespace tacipc;
  return run_stage(kExport, argc, argv, [](Stage& stage) {
    const TetMesh gel = read_tet_mesh(stage.input("--gel"));
    const TriangleMesh object = read_triangle_mesh(stage.input("--object"), 1.0);
    const PressFolder press = open_press(stage.input("--press"), stage.input("--gel"), gel, stage.input("--object"));
    const std::vector<double> times_s = press.times();
    const std::vector<Matrix4> poses = press.poses();

    std::vector<PvdEntry> surface, volume, bodies;
    const auto write = [&](const char* kind, std::size_t frame, const VtuGrid& grid, std::vector<PvdEntry>& entries) {
      const std::string name = fmt::format("{}_{:04}.vtu", kind, frame);
      write_file(stage.output(name), vtu_bytes(grid));
      entries.push_back({times_s[frame], name});
    };
    for (std::size_t frame = 0; frame < times_s.size(); ++frame) {
      write("surface", frame, surface_grid(gel, press, frame), surface);
      write("volume", frame, volume_grid(gel, press, frame), volume);
      write("object", frame, object_grid(object, poses[frame]), bodies);
    }
    write_file(stage.output("surface.pvd"), pvd_text(surface));
    write_file(stage.output("volume.pvd"), pvd_text(volume));
    write_file(stage.output("object.pvd"), pvd_text(bodies));
    write_file(stage.output("sample.glb"), glb_bytes(gel, object, press));
    stage.summarize({{"frames", times_s.size()},
                     {"gel_vertices", gel.num_vertices()},
                     {"tets", gel.num_tets()},
                     {"object_triangles", object.num_triangles()}});
  });
}
