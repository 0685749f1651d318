#include <fmt/core.h>

#include "common/base/files.h"
#include "common/stage/stage.h"
#include "stages/gel/export/frame_grids.h"
#include "stages/gel/export/gltf.h"
#include "stages/gel/export/open_press.h"
#include "stages/gel/export/surface_arrays.h"

namespace {

const tacipc::StageSpec kExport{
    .name = "export",
    .summary =
        "Write the frames of a press, a grasp or a scene as VTK files for ParaView, and as one binary glTF file for "
        "Blender.",
    .inputs = {
        {.flag = "--press", .help = "folder that press wrote, of one gel, of a grasp or of a scene"},
        {.flag = "--gel", .help = "gel.msh of tetmesh, the one that was pressed"},
        {.flag = "--object",
         .help = "object.ply of decimate, the one that was pressed; none for a scene, whose record names its bodies",
         .required = false}}};

}  // namespace

int main(int argc, char** argv) {
  using namespace tacipc;
  return run_stage(kExport, argc, argv, [](Stage& stage) {
    const OpenScene scene = open_scene(stage.input("--press"), stage.input("--gel"), stage.optional_input("--object"));
    std::vector<PvdEntry> surface, volume, bodies, soft;
    const auto write = [&](const std::string& kind, const std::string& name, std::size_t frame, std::size_t part,
                           const VtuGrid& grid, std::vector<PvdEntry>& entries) {
      const std::string file = fmt::format("{}{}{}_{:04}.vtu", kind, name.empty() ? "" : "_", name, frame);
      write_file(stage.output(file), vtu_bytes(grid));
      entries.push_back({scene.times_s[frame], file, part});
    };
    for (std::size_t frame = 0; frame < scene.times_s.size(); ++frame) {
      for (std::size_t g = 0; g < scene.gels.size(); ++g) {
        const OpenGel& gel = scene.gels[g];
        const auto placed = [&](VtuGrid grid) {
          return gel.world_from_gel.empty() ? grid : in_world(std::move(grid), gel.world_from_gel[frame]);
        };
        write("surface", gel.name, frame, g, placed(surface_grid(gel.mesh, gel.press, frame)), surface);
        write("volume", gel.name, frame, g, placed(volume_grid(gel.mesh, gel.press, frame)), volume);
      }
      for (std::size_t o = 0; o < scene.objects.size(); ++o) {
        const OpenObject& object = scene.objects[o];
        write("object", object.name, frame, o, object_grid(object.mesh, object.world_from_object[frame]), bodies);
      }
      for (std::size_t i = 0; i < scene.soft.size(); ++i) {
        const OpenSoft& body = scene.soft[i];
        write("soft", body.name, frame, i, soft_grid(body.mesh, body.positions[0], body.positions[frame]), soft);
      }
    }
    write_file(stage.output("surface.pvd"), pvd_text(surface));
    write_file(stage.output("volume.pvd"), pvd_text(volume));
    if (!bodies.empty()) write_file(stage.output("object.pvd"), pvd_text(bodies));
    if (!soft.empty()) write_file(stage.output("soft.pvd"), pvd_text(soft));
    write_file(stage.output("sample.glb"), glb_bytes(scene));
    write_surface_arrays(stage, scene);
    Eigen::Index vertices = 0, tets = 0, triangles = 0;
    for (const OpenGel& gel : scene.gels) {
      vertices += gel.mesh.num_vertices();
      tets += gel.mesh.num_tets();
    }
    for (const OpenObject& object : scene.objects) triangles += object.mesh.num_triangles();
    stage.summarize({{"frames", scene.times_s.size()},
                     {"gel_vertices", vertices},
                     {"tets", tets},
                     {"object_triangles", triangles}});
  });
}
