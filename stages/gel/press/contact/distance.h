// Squared distance of a contact pair of four vertices, point–triangle or edge–edge, in one form for every closest
// feature.
#pragma once

#include <array>

#include "common/base/types.h"

namespace tacipc {

using FourPoints = std::array<Vector3, 4>;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Closest points of a pair: r = Σ wᵢ xᵢ joins them. The weights sum to zero and are affine in k free parameters: k = 0
/// between two vertices, 1 between a vertex and the inside of an edge, 2 inside a triangle or between the insides of
/// two edges. At the minimum Aᵀr = 0. Columns of W and A from the k-th on are zero.
struct ClosestFeature {
  Eigen::Vector4d weights;        // w
  Eigen::Matrix<double, 4, 2> W;  // ∂w/∂parameters, 4 × k
  Eigen::Matrix<double, 3, 2> A;  // Σ xᵢ Wᵢ = ∂r/∂parameters, 3 × k, m
  int k;                          // number of free parameters
  Vector3 r;                      // vector from the second body to the first, m
  double squared_distance;        // |r|², m²
};

/// Closest feature of point x0 and triangle x1 x2 x3; w = (1, −b₀, −b₁, −b₂). A triangle without area counts as its
/// edges.
ClosestFeature closest_point_triangle(const FourPoints& x);

/// Closest feature of a point and a triangle that is a piece of a flat face. Edges and corners inside the face do not
/// act: if one of them is nearest, the squared distance is infinite, and a point above one belongs to one of the
/// triangles that meet there.
/// \param rim bit k: edge k, from x_{k+1} to the next corner, is an edge of the face; bit 3 + k: corner x_{k+1} is a
/// corner of the face
ClosestFeature closest_point_face(const FourPoints& x, unsigned rim);

/// Closest feature of edges x0x1 and x2x3; w = (1−s, s, −(1−t), −t). Edges parallel within 1e-13 rad count as the
/// nearest of their four end-point–edge pairs (one of several equally near ones). An edge without length counts as a
/// point.
ClosestFeature closest_edge_edge(const FourPoints& x);

/// Gradient of |r|² over the 12 coordinates, x0 first: 2 wᵢ r. The free parameters drop out because Aᵀr = 0.
Vector12 squared_distance_gradient(const ClosestFeature& feature);

/// Exact Hessian of |r|² while the feature stays the closest: 2 [w wᵀ ⊗ I − B (AᵀA)⁻¹ Bᵀ], B_{i,q} = W_iq r + wᵢ A_q.
/// Derivation: eliminate the parameters p from ∂²/∂(x,p)² |r|² by a Schur complement; ∂²/∂p² = 2 AᵀA, ∂²/∂x∂p = 2 B.
Matrix12 squared_distance_hessian(const ClosestFeature& feature);

/// (AᵀA)⁻¹ in the leading k × k block, zero elsewhere. For k = 2 the determinant is |A₀ × A₁|², which avoids
/// cancellation.
Eigen::Matrix2d inverse_gram(const ClosestFeature& feature);

}  // namespace tacipc
