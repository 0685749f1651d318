// Body of a relief: a short cylinder as a closed mesh of rings.
#pragma once

#include <vector>

#include "common/mesh/triangle_mesh.h"
#include "stages/object/emboss/texture.h"

namespace tacipc {

/// Object frame: axis z, bottom at z = 0, plain face at z = thickness, metres.
struct CoinShape {
  double radius_m = 0.0;
  double thickness_m = 0.0;
  double fillet_m = 0.0;  // radius of the rounded edge between face and side

  /// Radius of the flat part of the face.
  double face_radius_m() const { return radius_m - fillet_m; }
};

/// A circle of the mesh: `count` vertices at angles 2π i / count from x towards y.
struct Ring {
  double radius_m = 0.0;
  double z_m = 0.0;
  int count = 0;
};

/// Rings from the centre of the face outwards, down the side and back to the centre of the bottom, without the two
/// centre points. On face and fillet the spacing is at most h, and ring k of the face has 6k vertices at the radius k
/// h, so that all triangles are nearly equilateral. On the side and the bottom, which touch nothing, the spacing grows
/// by half from ring to ring, up to a twelfth of the radius.
std::vector<Ring> coin_rings(const CoinShape& shape, double spacing_m);

/// Number of mesh vertices for these rings, including both centre points.
int coin_vertices(const std::vector<Ring>& rings);

/// Widest spacing (to half a percent) whose mesh has at least `vertices`.
double coin_spacing(const CoinShape& shape, int vertices);

/// Closed mesh, outward oriented, with the face lifted by `relief_m` (metres above the plain face; zero from the radius
/// of the flat part on). Neighbouring rings are joined like a zipper, the shorter diagonal first. Vertex 0 is the
/// centre of the face, then follow the rings; the last vertex is the centre of the bottom. Relief values are computed
/// in parallel.
TriangleMesh coin_mesh(const CoinShape& shape, double spacing_m, const Height& relief_m);

}  // namespace tacipc
