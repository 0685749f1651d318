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
  std::vector<int> row_of(rows, -1);
  for (std::size_t i = 0; i < vertices.size(); ++i) row_of[static_cast<std::size_t>(vertices[i])] = static_cast<int>(i);
  out.triangles = mesh.faces(BoundaryTag::front);
  for (int& vertex : out.triangles.reshaped()) vertex = row_of[static_cast<std::size_t>(vertex)];
  out.gel_from_object = folder.poses();
  for (std::size_t k = 0; k < folder.extent(PressArray::positions, kFrames); ++k)
    out.frames.emplace_back(folder.positions(k)(vertices, Eigen::all));
  return out;
}

}  // namespace tacipc
