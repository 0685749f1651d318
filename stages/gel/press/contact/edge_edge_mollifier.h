// Mollifier of edge–edge energies: a factor that goes smoothly to zero as the two edges become parallel, because their
// distance has a kink there.
#pragma once

#include "stages/gel/press/contact/distance.h"

namespace tacipc {

/// c = |(x1 − x0) × (x3 − x2)|², m⁴: zero for parallel edges x0x1 and x2x3.
double edge_cross_squared_norm(const FourPoints& x);

/// Gradient of c. With u = x1 − x0, v = x3 − x2: ∂c/∂u = 2 v × (u × v), ∂c/∂v = 2 (u × v) × u.
Vector12 edge_cross_squared_norm_gradient(const FourPoints& x);

/// Hessian of c: ∂²c/∂u² = 2 (|v|² I − v vᵀ), ∂²c/∂u∂v = 4 u vᵀ − 2 v uᵀ − 2 (u·v) I, ∂²c/∂v² = 2 (|u|² I − u uᵀ).
Matrix12 edge_cross_squared_norm_hessian(const FourPoints& x);

/// sin² of the angle below which edges are mollified (1.8 degrees) [Li2020].
inline constexpr double kMollifiedSine2 = 1e-3;

/// Threshold ε = kMollifiedSine2 |e_a|² |e_b|² of the edges at rest, m⁴.
double edge_edge_mollifier_threshold(const FourPoints& x_rest);

/// Mollifier m(c) = −(c/ε)² + 2 c/ε for c < ε, else 1; C¹ at ε [Li2020].
double edge_edge_mollifier(double c, double epsilon);
/// First and second derivative of m by c.
double edge_edge_mollifier_d1(double c, double epsilon);
double edge_edge_mollifier_d2(double c, double epsilon);

/// Value and derivatives of m(c(x)); the Hessian is one-sided at c = ε.
struct EdgeEdgeMollifier {
  double value;
  Vector12 gradient;
  Matrix12 hessian;
};
/// Mollifier of a pair at x. \param epsilon edge_edge_mollifier_threshold()
EdgeEdgeMollifier edge_edge_mollifier(const FourPoints& x, double epsilon);

}  // namespace tacipc
