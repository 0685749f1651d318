#include "stages/gel/export/surface_arrays.h"

#include <functional>
#include <vector>

#include "common/format/npy.h"
#include "common/sample/placement.h"

namespace tacipc {
namespace {

/// Triangles over the vertices that they name alone, and which these are.
struct Surface {
  Triangles triangles;
  std::vector<int> vertices;
};

Surface surface_of(const Triangles& boundary, Eigen::Index num_vertices) {
  std::vector<int> number(static_cast<std::size_t>(num_vertices), -1);
  for (Eigen::Index i = 0; i < boundary.size(); ++i) number[static_cast<std::size_t>(boundary.data()[i])] = 0;
  Surface surface{.triangles = boundary, .vertices = {}};
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<int>(surface.vertices.size());
    surface.vertices.push_back(static_cast<int>(v));
  }
  for (Eigen::Index i = 0; i < boundary.size(); ++i)
    surface.triangles.data()[i] = number[static_cast<std::size_t>(boundary.data()[i])];
  return surface;
}

void write(Stage& stage, const std::string& name, const Triangles& boundary, const std::vector<double>& times_s,
           const std::function<Positions(std::size_t)>& positions_m) {
  const std::size_t frames = times_s.size();
  std::vector<double> positions, velocities;
  Surface surface;
  Positions before;
  for (std::size_t f = 0; f < frames; ++f) {
    const Positions all = positions_m(f);
    if (f == 0) surface = surface_of(boundary, all.rows());
    const Positions now = all(surface.vertices, Eigen::all);
    const Positions velocity =
        f == 0 ? Positions(Positions::Zero(now.rows(), 3)) : Positions((now - before) / (times_s[f] - times_s[f - 1]));
    positions.insert(positions.end(), now.data(), now.data() + now.size());
    velocities.insert(velocities.end(), velocity.data(), velocity.data() + velocity.size());
    before = now;
  }
  const std::string folder = "surfaces/" + name + "/";
  const std::vector<std::size_t> shape{frames, surface.vertices.size(), 3};
  write_npy(stage.output(folder + "positions.npy"), shape, positions.data());
  write_npy(stage.output(folder + "velocities.npy"), shape, velocities.data());
  write_npy(stage.output(folder + "triangles.npy"), {static_cast<std::size_t>(surface.triangles.rows()), 3},
            surface.triangles.data());
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
