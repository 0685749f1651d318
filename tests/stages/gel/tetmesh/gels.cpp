#include "tests/stages/gel/tetmesh/gels.h"

#include <gtest/gtest.h>

#include "stages/gel/tetmesh/tetmesh_config.h"

namespace tacipc {

GenerateConfig preset(const std::string& name) {
  return std::get<GenerateConfig>(read_config<TetmeshConfig>(config_path("gels/" + name + ".yaml")).way);
}

GelShape mctac_gel() { return read_config<Sensor>(config_path("sensors/mctac.yaml")).gel; }

GelShape disc_gel(double radius_m, double thickness_m) {
  GelShape gel;
  gel.radius_m = radius_m;
  gel.thickness_m = thickness_m;
  return gel;
}

GelShape rectangle_gel(double width_m, double height_m, double thickness_m) {
  GelShape gel;
  gel.outline = GelShape::Outline::rectangle;
  gel.width_m = width_m;
  gel.height_m = height_m;
  gel.thickness_m = thickness_m;
  return gel;
}

void expect_wanted_edges(const TetMesh& mesh, const GelShape& gel, const GenerateConfig& config, double tolerance,
                         Eigen::Index min_edges) {
  const Sizing sizing = sizing_for(config.sizing, gel);
  const GelEdges edges =
      edge_statistics(mesh, sizing.reach_m(), [&](const Vector3& x) { return target_edge_length(sizing, x); });
  for (const auto& [name, region] : {std::pair{"all", edges.all}, std::pair{"front_centre", edges.front_centre},
                                     std::pair{"front_inner", edges.front_inner},
                                     std::pair{"front_rim", edges.front_rim}, std::pair{"back", edges.back}}) {
    if (region.count < min_edges) continue;
    EXPECT_NEAR(region.mean_ratio, 1.0, tolerance) << name << ", " << region.count << " edges";
    EXPECT_GT(region.min_m, 0.0) << name;
  }
}

double volume_of(const TetMesh& mesh) {
  double volume = 0.0;
  for (Eigen::Index t = 0; t < mesh.num_tets(); ++t) {
    const Vector3 a = mesh.positions.row(mesh.tets(t, 0)), b = mesh.positions.row(mesh.tets(t, 1)),
                  c = mesh.positions.row(mesh.tets(t, 2)), d = mesh.positions.row(mesh.tets(t, 3));
    volume += (b - a).dot((c - a).cross(d - a)) / 6.0;
  }
  return volume;
}

}  // namespace tacipc
