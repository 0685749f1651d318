#include "common/sample/front_frames.h"

#include "common/mesh/tet_mesh.h"
#include "common/sample/press_folder.h"

namespace tacipc {

FrontFrames read_front_frames(const std::filesystem::path& press, const std::filesystem::path& gel) {
  const TetMesh mesh = read_tet_mesh(gel);
  const auto rows = static_cast<std::size_t>(mesh.num_vertices());
  PressFolder folder = PressFolder::finished(press, {{kVertices, rows}});
  const std::vector<int> vertices = mesh.vertices(BoundaryTag::front);

  FrontFrames out;
  out.triangles = mesh.surface(BoundaryTag::front);
  out.gel_from_object = folder.poses();
  for (std::size_t k = 0; k < folder.extent(PressArray::positions, kFrames); ++k)
    out.frames.emplace_back(folder.positions(k)(vertices, Eigen::all));
  return out;
}

}  // namespace tacipc
