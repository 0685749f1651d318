// Axisymmetric indenter, rigid or elastic, on an elastic layer bonded to a rigid base: the exact linear solution.
#pragma once

#include <optional>
#include <vector>

#include "verification/closed_forms.h"

namespace tacipc::verify {

/// Compliance of a bonded layer over that of a half space, in the Hankel domain, at ω = ξ h:
///   K(ω) = (2k sinh 2ω − 4ω) / (2k cosh 2ω + 1 + k² + 4ω²),   k = 3 − 4ν.
/// A pressure P(ξ) J₀(ξ r) on the surface sinks it by w = (2/E*) (K(ξh)/ξ) P(ξ) J₀(ξ r). K → 1 for ω → ∞ (half space),
/// K → 4ω (k − 1)/(k + 1)² for ω → 0, which is h p = (λ + 2μ) w (a bed of springs), except for ν = 1/2.
/// Derivation: u = (U(z) J₁, W(z) J₀) with four exponentials, U = W = 0 at the base, no shear on the surface; the test
/// solves that 4 × 4 system by itself.   [e.g. Meijers 1968; Johnson 1985, 5.8]
double bonded_layer_kernel(double omega, double poissons_ratio);

/// Gel layer and indenter.
struct LayerProblem {
  Elastic gel;
  double thickness_m = 0.0;
  enum class Shape { sphere, paraboloid, flat } shape = Shape::sphere;
  double radius_m = 0.0;  // radius of curvature, m; for `flat` the radius of the punch
  /// Elastic constants of a round elastic indenter, which yields as a half space does [Hertz 1882]; absent: rigid. The
  /// same pressure acts on both bodies, so their compliances add up: (2/E*) K(ξh)/ξ + (2/E*ᵢ)/ξ = (2/E*꜀) K꜀/ξ with
  ///   1/E*꜀ = 1/E* + 1/E*ᵢ,   1 − K꜀ = (E*꜀/E*) (1 − K).
  /// The depth is then the approach of the indenter's inside to the base since first contact.
  std::optional<Elastic> indenter = {};

  /// E*꜀ as defined above; under a rigid indenter E* of the layer.
  double combined_modulus_pa() const;
};

/// State of the contact.
struct LayerSolution {
  double force_n = 0.0;
  double depth_m = 0.0;
  double contact_radius_m = 0.0;
};

/// Solution for a given contact radius a. With P(ξ) = ∫₀ᵃ φ(t) cos(ξt) dt the dual integral equations become
///   φ(t) = (E*/π) (δ − q(t)) + ∫₀ᵃ M(t, s) φ(s) ds,   M = (2/π) ∫₀^∞ (1 − K(ξh)) cos ξt cos ξs dξ,
/// with E*꜀ and K꜀ for E* and K if the indenter is elastic. q is Abel's transform of the indenter's profile f(r): q(t)
/// = t ∫₀ᵗ f′(r)/√(t² − r²) dr, which is t²/R for a paraboloid, t artanh(t/R) for a sphere and 0 for a flat punch.
/// Contact with a round indenter ends smoothly, φ(a) = 0, which gives δ; then F = 2π ∫₀ᵃ φ dt. The equation is solved
/// by Gauss–Legendre collocation with `points` nodes.   [Lebedev & Ufliand 1958; Jaffar 1989]
/// \param depth_m δ; used only for a flat punch, where a is its radius
/// \pre a < R for a sphere
LayerSolution solve_bonded_layer(const LayerProblem& problem, double contact_radius_m, double depth_m, int points = 48);

/// Solution at a given depth. The contact radius is found by bisection, because depth grows with it.
LayerSolution press_bonded_layer(const LayerProblem& problem, double depth_m, int points = 48);

/// Nodes and weights of Gauss–Legendre quadrature on [low, high], by Newton on the Legendre polynomial.
struct Quadrature {
  std::vector<double> node, weight;
};
Quadrature gauss_legendre(int points, double low, double high);

}  // namespace tacipc::verify
