#include <fmt/core.h>

#include "common/files.h"
#include "common/stage.h"
#include "stages/export/frame_grids.h"

namespace {

const tacipc::StageSpec kExport{
    .name = "export",
    .summary = "Write the frames of a press as VTK files, for ParaView: surface, volume and object.",
    .inputs = {{.flag = "--press", .help = "folder that press wrote"},
               {.flag = "--gel", .help = "gel.msh of tetmesh, the one that was pressed"},
               {.flag = "--object", .help = "object.ply of decimate, the one that was pressed"}}};

}  // namespace

int main(int argc, char** argv) {
  using namespace tacipc;
  return run_stage(kExport, argc, argv, [](Stage& stage) {
    const TetMesh gel = read_tet_mesh(stage.input("--gel"));
    const TriangleMesh object = read_triangle_mesh(stage.input("--object"), 1.0);
    const PressArrays press = read_press(stage.input("--press"), stage.input("--gel"), gel, stage.input("--object"));

    std::vector<PvdEntry> surface, volume, bodies;
    const auto write = [&](const char* kind, std::size_t frame, const VtuGrid& grid, std::vector<PvdEntry>& entries) {
      const std::string name = fmt::format("{}_{:04}.vtu", kind, frame);
      write_file(stage.output(name), vtu_bytes(grid));
      entries.push_back({press.time_s[frame], name});
    };
    for (std::size_t frame = 0; frame < press.frames; ++frame) {
      write("surface", frame, surface_grid(gel, press, frame), surface);
      write("volume", frame, volume_grid(gel, press, frame), volume);
      write("object", frame, object_grid(object, press, frame), bodies);
    }
    write_file(stage.output("surface.pvd"), pvd_text(surface));
    write_file(stage.output("volume.pvd"), pvd_text(volume));
    write_file(stage.output("object.pvd"), pvd_text(bodies));
    stage.summarize({{"frames", press.frames},
                     {"gel_vertices", gel.num_vertices()},
                     {"tets", gel.num_tets()},
                     {"object_triangles", object.num_triangles()}});
  });
}
