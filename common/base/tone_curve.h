// Tone curves of images: from linear light to codes, and back.
#pragma once

#include <cmath>
#include <limits>
#include <string_view>

namespace tacipc {

/// f(v) = slope × v up to the toe, from there on scale × v^(1/gamma) − offset: sRGB's (IEC 61966-2-1) unless named
/// else.
struct ToneCurve {
  double toe = 0.0031308, slope = 12.92, scale = 1.055, gamma = 2.4, offset = 0.055;

  /// `linear`, `gamma` of this exponent, or `srgb`: the names in configurations.
  static ToneCurve named(std::string_view name, double gamma = 1.0) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (name == "linear") return {.toe = kInfinity, .slope = 1.0, .scale = 1.0, .gamma = 1.0, .offset = 0.0};
    if (name == "gamma") return {.toe = 0.0, .slope = 1.0, .scale = 1.0, .gamma = gamma, .offset = 0.0};
    return {};
  }

  /// 255 f(v); 0 for v below 0.
  double code_of(double v) const {
    if (v <= 0.0) return 0.0;
    return 255.0 * (v <= toe ? slope * v : scale * std::pow(v, 1.0 / gamma) - offset);
  }
  /// Its inverse, for codes ≥ 0.
  double value_of(double code) const {
    const double of_full = code / 255.0;
    return of_full <= slope * toe ? of_full / slope : std::pow((of_full + offset) / scale, gamma);
  }
};

}  // namespace tacipc
