// Edge length over the gel: one function that determines the points, edges and tetrahedra of a generated mesh.
#pragma once

#include "common/base/types.h"
#include "common/config/config.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Target edge lengths. On the front they depend on the distance r from the centre: `centre_m` up to `centre_radius_m`,
/// growing linearly to `inner_m` at `inner_radius_m`, then to `rim_m` at the outermost point of the gel.
struct SizingConfig {
  double centre_m = 0.0;
  double centre_radius_m = 0.0;
  double inner_m = 0.0;
  double inner_radius_m = 0.0;
  double rim_m = 0.0;
  double rim_exponent = 1.0;  // growth between inner radius and rim; 1: linear, 2: quadratic
  double back_m = 0.0;        // edge length on the glued face
  double depth_exponent = 1.0;

  /// Reads either `uniform_mm` or all of the graded keys.
  static SizingConfig read(ConfigReader& in);
  /// Whether the length is the same everywhere.
  bool uniform() const { return centre_m == inner_m && inner_m == rim_m && rim_m == back_m; }
};

/// Target edge lengths in one gel.
struct Sizing {
  SizingConfig config;
  GelShape gel;

  /// Distance of the outermost point of the gel from the axis, where `rim_m` is reached.
  double reach_m() const;
  /// Target edge length on the front face at distance `radius_m` from the centre.
  double front(double radius_m) const;
};

/// Sizing of one gel.
/// \throw DataError if the inner radius does not lie inside the gel, if hardly any thickness is left at the rim of a
/// dome, or if the dome of a rectangle is too steep to be triangulated as seen from above
Sizing sizing_for(const SizingConfig& config, const GelShape& gel);

/// Target edge length in metres at a rest point (frame S):
///   h = (1 − w) h_front(r) + w h_back,  w = (depth below the front / thickness of the gel there)^depth_exponent.
/// Points outside the gel count as the nearest depth.
double target_edge_length(const Sizing& sizing, const Vector3& rest_point);

/// Estimated number of vertices of a mesh with these edge lengths: on faces 2 / (√3 h²) per area, inside √2 / h³ per
/// volume (the densities of equilateral triangles and of the densest packing). Integrated on a grid graded like the
/// sizing.
double estimated_vertices(const Sizing& sizing);

}  // namespace tacipc
