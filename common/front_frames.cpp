#include "common/front_frames.h"

#include <cmath>

#include "common/error.h"
#include "common/npy.h"
#include "common/tet_mesh.h"

namespace tacipc {

FrontFrames read_front_frames(const std::filesystem::path& press, const std::filesystem::path& gel) {
  if (!std::filesystem::exists(press / "press.yaml"))
    throw DataError("{}: has no press.yaml, so the press did not finish", press.string());
  const TetMesh mesh = read_tet_mesh(gel);
  const std::vector<int> vertices = mesh.vertices(BoundaryTag::front);
  const NpyArray positions = read_npy(press / "positions.npy"), poses = read_npy(press / "object_pose.npy");
  const auto rows = static_cast<std::size_t>(mesh.num_vertices());
  if (positions.shape.size() != 3 || positions.shape[1] != rows || positions.shape[2] != 3)
    throw DataError("{}: does not hold positions of the {} vertices of {}", (press / "positions.npy").string(), rows,
                    gel.string());
  const std::size_t frames = positions.shape[0];
  if (poses.shape != std::vector<std::size_t>{frames, 4, 4})
    throw DataError("{}: does not hold {} poses", (press / "object_pose.npy").string(), frames);
  for (const double value : positions.data)
    if (!std::isfinite(value)) throw DataError("{}: not all numbers are finite", (press / "positions.npy").string());

  FrontFrames out;
  std::vector<int> row_of(rows, -1);
  for (std::size_t i = 0; i < vertices.size(); ++i) row_of[static_cast<std::size_t>(vertices[i])] = static_cast<int>(i);
  out.triangles = mesh.faces(BoundaryTag::front);
  for (Eigen::Index t = 0; t < out.triangles.size(); ++t)
    out.triangles.data()[t] = row_of[static_cast<std::size_t>(out.triangles.data()[t])];
  for (std::size_t k = 0; k < frames; ++k) {
    const Eigen::Map<const Positions> all(&positions.data[k * rows * 3], static_cast<Eigen::Index>(rows), 3);
    out.frames.emplace_back(all(vertices, Eigen::all));
    out.gel_from_object.emplace_back(
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(&poses.data[16 * k]));
  }
  return out;
}

}  // namespace tacipc
