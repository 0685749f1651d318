// Closed forms for comparison with the press. SI units.
#pragma once

#include <string>
#include <vector>

#include "common/sensor/sensor.h"

namespace tacipc::verify {

/// Isotropic elastic constants.
struct Elastic {
  double youngs_modulus_pa = 0.0;
  double poissons_ratio = 0.0;

  double shear_modulus_pa() const { return youngs_modulus_pa / (2.0 * (1.0 + poissons_ratio)); }
  /// E* = E / (1 − ν²), the modulus for contact with a rigid body, Pa.
  double plane_modulus_pa() const { return youngs_modulus_pa / (1.0 - poissons_ratio * poissons_ratio); }
  /// λ = E ν / ((1 + ν)(1 − 2ν))
  double lame_lambda_pa() const;
};

/// Force and contact radius of a rigid indenter at a depth.
struct Indentation {
  double force_n = 0.0;
  double contact_radius_m = 0.0;
};

/// Paraboloid of radius of curvature R on a half space: F = 4/3 E* √R δ^{3/2}, a = √(R δ).   [Hertz 1882]
Indentation hertz(const Elastic& gel, double radius_m, double depth_m);

/// Rigid sphere of radius R on a half space, with its true shape: δ = a artanh(a/R),
/// F = E* [(a² + R²) artanh(a/R) − a R].   [Sneddon 1965, eq. 6.14 and 6.15, rewritten with artanh]
Indentation sneddon_sphere(const Elastic& gel, double radius_m, double depth_m);

/// Flat-ended rigid cylinder of radius a, frictionless, on a half space: F = 2 E* a δ.   [Boussinesq; Johnson
/// 1985, 3.4]
double flat_punch_force_n(const Elastic& gel, double punch_radius_m, double depth_m);

/// Sphere on a layer of thickness h bonded to a rigid base, series in χ = √(R δ)/h:
/// F = 4/3 E* √R δ^{3/2} [1 − (2α/π) χ + (4α²/π²) χ² − (8/π³)(α³ + (4π²/15) β) χ³ + (16α/π⁴)(α³ + (3π²/5) β) χ⁴],
/// α = −(1.2876 − 1.4678 ν + 1.3442 ν²)/(1 − ν), β = (0.6387 − 1.0277 ν + 1.5164 ν²)/(1 − ν).   [Dimitriadis et al.
/// 2002]
double dimitriadis_force_n(const Elastic& gel, double thickness_m, double radius_m, double depth_m);

/// Tangential force of a wide layer of area A between bonded faces that move by u against each other: F = G A u / h.
/// Exact inside for neo-Hookean material at any shear; the free rim takes away a part of order h / width.
double layer_shear_force_n(const Elastic& gel, double thickness_m, double area_m2, double shift_m);

/// Torque that twists a cylinder of radius R and height h between bonded faces by θ: T = π G θ R⁴ / (2 h).
double disc_twist_torque_n_m(const Elastic& gel, double radius_m, double thickness_m, double angle_rad);

/// Uniform compression by the stretch s along z with free sides.
struct Compression {
  double lateral_stretch = 1.0;
  double nominal_stress_pa = 0.0;  // first Piola–Kirchhoff P_zz, negative in compression
  double true_stress_pa = 0.0;     // Cauchy stress, Pa
};

/// Uniform compression of a material by the axial stretch s.
/// Neo-Hookean, Ψ = μ/2 (tr FᵀF − 3) − μ ln J + λ/2 (ln J)²: the lateral stretch t solves μ (t² − 1) + λ ln(s t²) = 0
/// (P_xx t = 0), by Newton in ln t; P_zz = μ s − (μ − λ ln(s t²))/s.
/// StVK in Hencky strain, Ψ = μ tr ε² + λ/2 (tr ε)², ε = logarithm of the stretches: ε_t = −ν ε_s, P_zz = E ε_s / s.
/// \param law "neo_hookean" or "stvk_hencky"
/// \throw UsageError for any other law
Compression uniform_compression(const std::string& law, const Elastic& gel, double axial_stretch);

/// Ratio of the force to the long-term elastic force, a time t = `held_s` after a small strain was applied at a
/// constant rate over T = `ramp_s`: 1 + Σ (gᵢ/g∞) (τᵢ/T) (1 − e^{−T/τᵢ}) e^{−t/τᵢ}, g∞ = 1 − Σ gᵢ.   [Prony series;
/// Christensen 1982]
double relaxing_force_factor(const std::vector<Relaxation>& series, double ramp_s, double held_s);

}  // namespace tacipc::verify
