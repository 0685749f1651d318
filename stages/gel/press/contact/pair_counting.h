// Weights of contact pairs: each piece of the other surface pushes once, or once for each primitive whose closest point
// it is.
#pragma once

#include "stages/gel/press/contact/contact_laws.h"
#include "stages/gel/press/contact/contact_search.h"

namespace tacipc {

/// Options of the weights of pairs between two bodies.
struct PairCounting {
  /// True: every piece of surface near a vertex pushes on it once. False: each pair counts by itself [Li et al. 2020],
  /// so that a vertex is pushed once above the middle of a triangle, twice above an edge and six times above a corner.
  /// This gives a smooth surface bumps of the size of its triangles, which friction catches on (docs/board3.md).
  bool once = false;
  /// If `once`: smallest weight of edge–edge pairs. Their weight is the sharpness of the object's edge, of the sharper
  /// one of two (contact/sharpness.h). On smooth surfaces vertices bear the load, and edge pairs only prevent edges
  /// from crossing; at sharp edges they bear the load.
  double edge_weight = 0.02;
};

/// Returns the pairs with their weights. If counted once, the energy of a vertex p with the triangles t of the other
/// surface near it is
///   Σ_t b(p, t) − Σ_e b(p, e) + Σ_v b(p, v)
/// over those triangles, their edges e and corners v, each once [the improved maximum of Li et al. 2023, "Convergent
/// incremental potential contact"]. With χ(τ) the Euler characteristic of the surface's part within distance τ of p,
/// this is −∫ b′(τ) χ(τ) dτ: one b for each piece that is topologically a disc, wherever its triangles meet. The
/// nearest feature always counts +1, so the sum still grows without bound at contact.
///
/// Edges and corners are stored as point–triangle pairs that repeat their last vertex: (p, e₀, e₁, e₁) and (p, v, v,
/// v). Pairs within one gel keep their weight, because their reach differs from pair to pair.
///
/// Between two rigid bodies the shapes count instead of the triangles (contact/shape_features.h): p are the corners,
/// and the sum Σ_F b(p, F) − Σ_e b(p, e) + Σ_v b(p, v) is over whole flat faces F, their whole creases e and their
/// corners v. Vertices and edges inside of flat faces add no support. Counted by triangles, an edge inside of a flat
/// face would push back a crease that ends next to it, and a vertex inside of it would push back the rim of another
/// body: spurious hills. In addition, energies of triangles that cancel except for rounding have Hessians that do not
/// cancel, so Newton steps would go sideways above the edges between them.
///
/// All weights are multiplied by the stiffness of the bodies' law.
/// \pre triangles around every edge within reach of a vertex are in `pairs`, as ContactSearch finds them; no pair has
/// been weighted yet
std::vector<ContactPair> weighted(std::vector<ContactPair> pairs, const ContactMesh& mesh, const ContactLaws& laws,
                                  const PairCounting& counting);

}  // namespace tacipc
