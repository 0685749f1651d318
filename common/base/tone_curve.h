// Tone curves of images: conversion of linear light to 8-bit values and back.
#pragma once

#include <cmath>
#include <limits>
#include <string_view>

namespace tacipc {

/// Tone curve f(v) = slope × v up to the toe, from there on scale × v^(1/gamma) − offset. The default is sRGB's (IEC
/// 61966-2-1).
struct ToneCurve {
  double toe = 0.0031308, slope = 12.92, scale = 1.055, gamma = 2.4, offset = 0.055;

  /// Returns the curve with a name from configurations: `linear`, `gamma` with this exponent, or `srgb`.
  static ToneCurve named(std::string_view name, double gamma = 1.0) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (name == "linear") return {.toe = kInfinity, .slope = 1.0, .scale = 1.0, .gamma = 1.0, .offset = 0.0};
    if (name == "gamma") return {.toe = 0.0, .slope = 1.0, .scale = 1.0, .gamma = gamma, .offset = 0.0};
    return {};
  }

  /// Returns 255 f(v), not rounded; 0 for v below 0.
  double code_of(double v) const {
    if (v <= 0.0) return 0.0;
    return 255.0 * (v <= toe ? slope * v : scale * std::pow(v, 1.0 / gamma) - offset);
  }
  /// Inverse of code_of(), for values ≥ 0.
  double value_of(double code) const {
    const double of_full = code / 255.0;
    return of_full <= slope * toe ? of_full / slope : std::pow((of_full + offset) / scale, gamma);
  }
};

}  // namespace tacipc
