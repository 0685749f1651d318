#include "verification/closed_forms.h"

#include <cmath>
#include <numbers>

#include "common/base/error.h"

namespace tacipc::verify {

using std::numbers::pi;

double Elastic::lame_lambda_pa() const {
  const double nu = poissons_ratio;
  return youngs_modulus_pa * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
}

Indentation hertz(const Elastic& gel, double radius_m, double depth_m) {
  return {4.0 / 3.0 * gel.plane_modulus_pa() * std::sqrt(radius_m) * std::pow(depth_m, 1.5),
          std::sqrt(radius_m * depth_m)};
}

Indentation sneddon_sphere(const Elastic& gel, double radius_m, double depth_m) {
  // x artanh x grows monotonically, so bisection of x = a/R in (0, 1) cannot fail.
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double x = 0.5 * (low + high);
    (x * std::atanh(x) < depth_m / radius_m ? low : high) = x;
  }
  const double R = radius_m, a = low * R;
  return {gel.plane_modulus_pa() * ((a * a + R * R) * std::atanh(low) - a * R), a};
}

double flat_punch_force_n(const Elastic& gel, double punch_radius_m, double depth_m) {
  return 2.0 * gel.plane_modulus_pa() * punch_radius_m * depth_m;
}

double dimitriadis_force_n(const Elastic& gel, double thickness_m, double radius_m, double depth_m) {
  const double nu = gel.poissons_ratio, chi = std::sqrt(radius_m * depth_m) / thickness_m;
  const double alpha = -(1.2876 - 1.4678 * nu + 1.3442 * nu * nu) / (1.0 - nu);
  const double beta = (0.6387 - 1.0277 * nu + 1.5164 * nu * nu) / (1.0 - nu);
  const double cube = alpha * alpha * alpha;
  const double bracket = 1.0 - 2.0 * alpha / pi * chi + 4.0 * alpha * alpha / (pi * pi) * chi * chi -
                         8.0 / (pi * pi * pi) * (cube + 4.0 * pi * pi / 15.0 * beta) * std::pow(chi, 3) +
                         16.0 * alpha / std::pow(pi, 4) * (cube + 3.0 * pi * pi / 5.0 * beta) * std::pow(chi, 4);
  return hertz(gel, radius_m, depth_m).force_n * bracket;
}

double layer_shear_force_n(const Elastic& gel, double thickness_m, double area_m2, double shift_m) {
  return gel.shear_modulus_pa() * area_m2 * shift_m / thickness_m;
}

double disc_twist_torque_n_m(const Elastic& gel, double radius_m, double thickness_m, double angle_rad) {
  return pi * gel.shear_modulus_pa() * angle_rad * std::pow(radius_m, 4) / (2.0 * thickness_m);
}

Compression uniform_compression(const std::string& law, const Elastic& gel, double axial_stretch) {
  const double s = axial_stretch, mu = gel.shear_modulus_pa(), lambda = gel.lame_lambda_pa();
  Compression out;
  if (law == "neo_hookean") {
    // f(y) = μ (e^{2y} − 1) + λ (ln s + 2y), y = ln t, is convex and increasing: Newton converges from above.
    double y = s < 1.0 ? -std::log(s) : std::log(s);
    for (int i = 0; i < 100; ++i) {
      const double e = std::exp(2.0 * y);
      const double step = (mu * (e - 1.0) + lambda * (std::log(s) + 2.0 * y)) / (2.0 * (mu * e + lambda));
      y -= step;
      if (std::abs(step) < 1e-16) break;
    }
    out.lateral_stretch = std::exp(y);
    out.nominal_stress_pa = mu * s - (mu - lambda * (std::log(s) + 2.0 * y)) / s;
  } else if (law == "stvk_hencky") {
    out.lateral_stretch = std::pow(s, -gel.poissons_ratio);
    out.nominal_stress_pa = gel.youngs_modulus_pa * std::log(s) / s;
  } else {
    throw UsageError("no closed form of uniform compression for the material law '" + law + "'");
  }
  out.true_stress_pa = out.nominal_stress_pa / (out.lateral_stretch * out.lateral_stretch);
  return out;
}

double relaxing_force_factor(const std::vector<Relaxation>& series, double ramp_s, double held_s) {
  double lasting = 1.0, factor = 1.0;
  for (const Relaxation& member : series) lasting -= member.part;
  for (const Relaxation& member : series) {
    const double tau = member.time_s;
    factor += member.part / lasting * tau / ramp_s * -std::expm1(-ramp_s / tau) * std::exp(-held_s / tau);
  }
  return factor;
}

}  // namespace tacipc::verify
