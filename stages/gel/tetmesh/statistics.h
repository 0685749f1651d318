// Statistics of a mesh for the record: counts, edge lengths by region, shapes of tetrahedra, volume.
#pragma once

#include <functional>

#include "common/base/value.h"
#include "common/mesh/tet_mesh.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Volume of the gel's ideal shape, m³ (a disc's dome in closed form, a rectangle's by Simpson's rule).
double analytic_volume(const GelShape& gel);

/// Edge lengths of one region; the ratio is to the target length at the edge's midpoint.
struct EdgeStatistics {
  Eigen::Index count = 0;
  double mean_m = 0.0;
  double min_m = 0.0;
  double max_m = 0.0;
  double mean_ratio = 0.0;
};
/// Regions: all edges (`all`); edges of the front whose midpoint lies within 0.1 of the gel's reach from the centre
/// (`front_centre`), between 0.35 and 0.43 (`front_inner`), or beyond 0.85 (`front_rim`); edges of the glued face
/// (`back`).
struct GelEdges {
  EdgeStatistics all, front_centre, front_inner, front_rim, back;
};
/// Computes the statistics.
/// \param reach_m distance of the outermost point of the gel from the axis
/// \param wanted_edge_length_m target length at a point
GelEdges edge_statistics(const TetMesh& mesh, double reach_m,
                         const std::function<double(const Vector3&)>& wanted_edge_length_m);

/// Summary for a soft object's record: its counts, edges of all tetrahedra and of the surface, and shapes.
/// \param edge_m target length
Value::Map summary(const TetMesh& mesh, double edge_m);

/// Summary for a gel's record. Without a target length (imported meshes) the ratios are left out.
Value::Map summary(const TetMesh& mesh, const GelShape& gel,
                   const std::function<double(const Vector3&)>& wanted_edge_length_m);

}  // namespace tacipc
