// Shapes of the stress campaign: coarse gels; objects sharp, round, bumpy, holed, in any position and resolution.
#pragma once

#include <string>

#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sensor/sensor.h"
#include "verification/stress_config.h"

namespace tacipc::verify {

struct StressGel {
  GelShape shape;
  TetMesh mesh;
  double front_edge_m = 0.0;  // median edge of the front
};

/// Draws a rectangular or round gel with about as many vertices as drawn.
StressGel draw_gel(const StressConfig::Gel& ranges, double exact_share, Draws& draws);

/// Moves every vertex that lies on no edge and not on the glued face or a side by up to `part` of its shortest edge, in
/// the front face along it. A move that would leave a tetrahedron less than a quarter of its volume is not made.
void jitter_vertices(TetMesh& mesh, double part, Draws& draws);

struct StressObject {
  std::string kind;
  TriangleMesh mesh;  // closed, outward; turned as it presses; lowest point at z = 0
  double size_m = 0.0;
  double tilt_rad = 0.0;        // of its axis from the vertical; for a box the rest after choosing a side to stand on
  double half_angle_rad = 0.0;  // zero where the kind has no tip
  double edge_m = 0.0;          // wanted
};

StressObject draw_object(const StressConfig::Object& ranges, double gel_edge_m, Draws& draws);

/// Splits every triangle in four, until no edge is longer than `edge_m`, or another split would make more than
/// `max_vertices`.
TriangleMesh split_triangles(TriangleMesh mesh, double edge_m, int max_vertices);

/// Sphere of radius 1 by an octahedron whose faces are split into n² triangles each.
TriangleMesh octahedral_sphere(int n);

/// Torus about z with radius 1 from the axis to the tube's centre, lowest at z = −tube.
TriangleMesh torus(double tube, int around, int across);

/// Largest distance from its own middle (of the bounding box, in the plane) of the part of a surface within `depth_m`
/// above its lowest point, cut exactly.
double contact_radius_m(const TriangleMesh& mesh, double depth_m);

}  // namespace tacipc::verify
