// How often a piece of the other surface pushes: once, or once for each primitive whose closest point it is.
#pragma once

#include "stages/gel/press/contact/contact_laws.h"
#include "stages/gel/press/contact/contact_search.h"

namespace tacipc {

/// Weights of the pairs between two bodies.
struct PairCounting {
  /// Every piece of surface near a vertex pushes on it once. Otherwise each pair counts by itself [Li et al. 2020]: a
  /// vertex is pushed once above the middle of a triangle, twice above an edge, six times above a corner, which gives a
  /// smooth surface bumps of the size of its triangles that friction catches on (docs/board3.md).
  bool once = false;
  /// Where once: least weight of edge–edge pairs, which count as much as the object's edge is sharp, the sharper one of
  /// two (contact/sharpness.h). On smooth surfaces they only keep edges from crossing, as vertices carry the load; at
  /// sharp edges they carry it.
  double edge_weight = 0.02;
};

/// The pairs with their weights. Where counted once, for each vertex p and the triangles t of the other surface near
/// it,
///   Σ_t b(p, t) − Σ_e b(p, e) + Σ_v b(p, v)
/// over those triangles, their edges e and corners v, each once   [the improved maximum of Li et al. 2023, "Convergent
/// incremental potential contact"]. With the surface's part within distance τ of p and its Euler characteristic χ(τ)
/// this is −∫ b′(τ) χ(τ) dτ: 1 b for each piece that looks like a disc, wherever its triangles meet. The nearest
/// feature always counts +1, so the sum still grows without bound at contact.
///
/// Edges and corners come as pairs point–triangle that repeat their last vertex: (p, e₀, e₁, e₁) and (p, v, v, v).
/// Pairs within one gel are left as they are: the reach of theirs differs from pair to pair.
///
/// Of two rigid bodies the shapes count, not the triangles (contact/shape_features.h): of vertices the corners p, of
/// triangles whole flat faces F, of edges the creases, each whole; Σ_F b(p, F) − Σ_e b(p, e) + Σ_v b(p, v) over the
/// faces and their edges and corners. Vertices and edges inside of flat faces carry nothing that those do not. Counted
/// by triangles, an edge inside of a flat face would push back a crease that ends beside it, and a vertex inside of it
/// the rim of another body: hills on which nothing rests. And as triangles that cancel but for rounding have Hessians
/// that do not, Newton's steps would go sideways above the edges between them.
///
/// All are multiplied by the stiffness of their bodies' law. \pre triangles around every edge within reach of a vertex
/// are in `pairs`, as ContactSearch finds them; none has been weighted yet.
std::vector<ContactPair> weighted(std::vector<ContactPair> pairs, const ContactMesh& mesh, const ContactLaws& laws,
                                  const PairCounting& counting);

}  // namespace tacipc
