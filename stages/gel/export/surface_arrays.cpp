#include "stages/gel/export/surface_arrays.h"

#include <functional>
#include <vector>

#include "common/format/npy.h"
#include "common/sample/placement.h"
#include "stages/gel/export/frame_grids.h"

namespace tacipc {
namespace {

void write(Stage& stage, const std::string& name, Triangles triangles, const std::vector<double>& times_s,
           const std::function<Positions(std::size_t)>& positions_m) {
  const std::size_t frames = times_s.size();
  std::vector<double> positions, velocities;
  const std::vector<int> vertices = drop_unused({triangles.data(), static_cast<std::size_t>(triangles.size())});
  Positions before;
  for (std::size_t f = 0; f < frames; ++f) {
    const Positions now = positions_m(f)(vertices, Eigen::all);
    const Positions velocity =
        f == 0 ? Positions(Positions::Zero(now.rows(), 3)) : Positions((now - before) / (times_s[f] - times_s[f - 1]));
    positions.insert(positions.end(), now.data(), now.data() + now.size());
    velocities.insert(velocities.end(), velocity.data(), velocity.data() + velocity.size());
    before = now;
  }
  const std::string folder = "surfaces/" + name + "/";
  const std::vector<std::size_t> shape{frames, vertices.size(), 3};
  write_npy(stage.output(folder + "positions.npy"), shape, positions.data());
  write_npy(stage.output(folder + "velocities.npy"), shape, velocities.data());
  write_npy(stage.output(folder + "triangles.npy"), {static_cast<std::size_t>(triangles.rows()), 3}, triangles.data());
}

}  // namespace

void write_surface_arrays(Stage& stage, const OpenScene& scene) {
  for (const OpenGel& gel : scene.gels) {
    write(stage, gel.name.empty() ? "gel" : gel.name, gel.mesh.boundary, scene.times_s, [&](std::size_t f) {
      const Positions own = gel.press.positions(f);
      return gel.world_from_gel.empty() ? own : transformed(gel.world_from_gel[f], own);
    });
  }
  for (const OpenObject& object : scene.objects) {
    write(stage, object.name.empty() ? "object" : object.name, object.mesh.triangles, scene.times_s,
          [&](std::size_t f) { return transformed(object.world_from_object[f], object.mesh.positions); });
  }
  for (const OpenSoft& soft : scene.soft)
    write(stage, soft.name, soft.mesh.boundary, scene.times_s, [&](std::size_t f) { return soft.positions[f]; });
}

}  // namespace tacipc
