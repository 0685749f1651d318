// Shapes of the stress campaign: coarse gels; objects sharp, round, bumpy, holed, in any position and resolution.
#pragma once

#include <string>

#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sensor/sensor.h"
#include "verification/stress_config.h"

namespace tacipc::verify {

/// Drawn gel.
struct StressGel {
  GelShape shape;
  TetMesh mesh;
  double front_edge_m = 0.0;  // median edge of the front
};

/// Draws a rectangular or round gel with about the drawn number of vertices.
StressGel draw_gel(const StressConfig::Gel& ranges, double exact_share, Draws& draws);

/// Moves every vertex that lies on no edge, on no side and not on the glued face by up to `part` of its shortest edge.
/// Vertices of the front move along the front. A move is skipped if it would leave a tetrahedron less than a quarter of
/// its volume.
void jitter_vertices(TetMesh& mesh, double part, Draws& draws);

/// Drawn object.
struct StressObject {
  std::string kind;
  TriangleMesh mesh;  // closed, outward triangles, in the orientation of the press; lowest point at z = 0
  double size_m = 0.0;
  double tilt_rad =
      0.0;  // tilt of the axis from the vertical, rad; for a box the remaining tilt after a side to stand on was chosen
  double half_angle_rad = 0.0;  // half angle of the tip, rad; zero for kinds without a tip
  double edge_m = 0.0;          // target edge length, m
};

/// Draws an object. `gel_edge_m` is the median edge of the gel's front.
StressObject draw_object(const StressConfig::Object& ranges, double gel_edge_m, Draws& draws);

/// Splits every triangle into four until no edge is longer than `edge_m`, or until another split would exceed
/// `max_vertices`.
TriangleMesh split_triangles(TriangleMesh mesh, double edge_m, int max_vertices);

/// Sphere of radius 1: an octahedron whose faces are split into n² triangles each.
TriangleMesh octahedral_sphere(int n);

/// Torus about z with radius 1 from the axis to the tube's centre, lowest at z = −tube.
TriangleMesh torus(double tube, int around, int across);

/// Contact radius at a depth: largest distance of the surface within `depth_m` above the lowest point (cut exactly)
/// from the centre of its bounding box, in the plane, m.
double contact_radius_m(const TriangleMesh& mesh, double depth_m);

}  // namespace tacipc::verify
