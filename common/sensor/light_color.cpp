#include "common/sensor/light_color.h"

#include <cmath>
#include <numbers>

namespace tacipc {
namespace {

/// Returns one Gaussian lobe of the colour-matching fit, with a width for each side.
double lobe(double nanometre, double mean, double left, double right) {
  const double t = (nanometre - mean) * (nanometre < mean ? left : right);
  return std::exp(-0.5 * t * t);
}

Vector3 srgb_from(const Vector3& xyz) {
  Matrix3 srgb_from_xyz;  // IEC 61966-2-1, white D65
  srgb_from_xyz << 3.2404542, -1.5371385, -0.4985314, -0.9692660, 1.8760108, 0.0415560, 0.0556434, -0.2040259,
      1.0572252;
  return srgb_from_xyz * xyz;
}

/// Returns the CIE 1931 colour-matching functions X, Y, Z at a wavelength (piecewise Gaussian fit of Wyman et al.
/// 2013).
Vector3 color_matching(double nanometre) {
  const double w = nanometre;
  return {1.056 * lobe(w, 599.8, 0.0264, 0.0323) + 0.362 * lobe(w, 442.0, 0.0624, 0.0374) -
              0.065 * lobe(w, 501.1, 0.0490, 0.0382),
          0.821 * lobe(w, 568.8, 0.0213, 0.0247) + 0.286 * lobe(w, 530.9, 0.0613, 0.0322),
          1.217 * lobe(w, 437.0, 0.0845, 0.0278) + 0.681 * lobe(w, 459.0, 0.0385, 0.0725)};
}

}  // namespace

std::array<double, 3> color_of_temperature(double kelvin) {
  constexpr double kSecondRadiation = 1.438776877e7;  // nm K
  Vector3 xyz = Vector3::Zero();
  for (int nanometre = 380; nanometre <= 780; nanometre += 5) {
    const double w = nanometre;
    xyz += std::pow(w / 560.0, -5.0) / std::expm1(kSecondRadiation / (w * kelvin)) * color_matching(w);
  }
  const Vector3 color = srgb_from(xyz).cwiseMax(0.0);
  return {color.x() / color.maxCoeff(), color.y() / color.maxCoeff(), color.z() / color.maxCoeff()};
}

std::array<double, 3> color_of_line(double peak_nm, double fwhm_nm) {
  const double deviation = fwhm_nm / (2.0 * std::sqrt(2.0 * std::numbers::ln2));
  Vector3 xyz = Vector3::Zero();
  for (int nanometre = 360; nanometre <= 830; ++nanometre) {
    const double t = (nanometre - peak_nm) / deviation;
    xyz += std::exp(-0.5 * t * t) * color_matching(nanometre);
  }
  const Vector3 color = srgb_from(xyz) / xyz.y();
  return {color.x(), color.y(), color.z()};
}

}  // namespace tacipc
