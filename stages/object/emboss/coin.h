// The body that carries a relief: a short cylinder as a closed mesh of rings.
#pragma once

#include <vector>

#include "common/mesh/triangle_mesh.h"
#include "stages/object/emboss/texture.h"

namespace tacipc {

/// Object frame: axis z, bottom at z = 0, plain face at z = thickness, metres.
struct CoinShape {
  double radius_m = 0.0;
  double thickness_m = 0.0;
  double fillet_m = 0.0;  // rounding of the edge between face and side

  /// Radius of the flat part of the face.
  double face_radius_m() const { return radius_m - fillet_m; }
};

/// A circle of the mesh: `count` vertices at angles 2π i / count from x towards y.
struct Ring {
  double radius_m = 0.0;
  double z_m = 0.0;
  int count = 0;
};

/// The rings from the middle of the face outwards, down the side and back to the middle of the bottom; the two middle
/// points themselves are not listed. Face and fillet: spacing at most h, and ring k of the face has 6k vertices at the
/// radius k h, so that all triangles are nearly equilateral. Side and bottom, which touch nothing: spacing grows by
/// half from ring to ring up to a twelfth of the radius.
std::vector<Ring> coin_rings(const CoinShape& shape, double spacing_m);

/// Vertices of the mesh over these rings, both middle points included.
int coin_vertices(const std::vector<Ring>& rings);

/// The widest spacing (to half a percent) whose mesh has at least `vertices`.
double coin_spacing(const CoinShape& shape, int vertices);

/// Closed mesh, outward oriented: face lifted by `relief_m` (metres above the plain face; it must vanish from the
/// radius of the flat part on). Neighbouring rings are joined like a zipper, the shorter diagonal first. Vertex 0 is
/// the middle of the face, then ring by ring, the last is the middle of the bottom. Relief values are computed in
/// parallel.
TriangleMesh coin_mesh(const CoinShape& shape, double spacing_m, const Height& relief_m);

}  // namespace tacipc
