// Light through planar layers: the one path from a point to a point, and how much arrives, in closed form.
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "common/base/simd.h"

namespace tacipc {

/// Layers across z from a source (layer 0) to a receiver (the last), each with thickness and refractive index. The last
/// thickness is that at z = 0; receivers lie elsewhere.
struct LayerStack {
  static constexpr int kMaxLayers = 8;
  std::array<double, kMaxLayers> thickness_m{};
  std::array<double, kMaxLayers> ior{};
  int count = 0;

  void add(double thickness, double index) {
    assert(count < kMaxLayers);
    thickness_m[static_cast<std::size_t>(count)] = thickness;
    ior[static_cast<std::size_t>(count++)] = index;
  }
  double lowest_ior() const {
    double lowest = ior[0];
    for (int i = 1; i < count; ++i)
      lowest = ior[static_cast<std::size_t>(i)] < lowest ? ior[static_cast<std::size_t>(i)] : lowest;
    return lowest;
  }
};

TACIPC_INLINE double root(double x) { return std::sqrt(x); }
TACIPC_INLINE Pack root(const Pack& x) {
  Pack out;
  for (int l = 0; l < kLanes; ++l) out[l] = std::sqrt(x[l]);
  return out;
}
/// True if |small| ≤ bound · |large| in every lane.
TACIPC_INLINE bool negligible(double small, double large, double bound) {
  return std::abs(small) <= bound * std::abs(large);
}
TACIPC_INLINE bool negligible(const Pack& small, const Pack& large, double bound) {
  int above = 0;
  for (int l = 0; l < kLanes; ++l) above += !(std::abs(small[l]) <= bound * std::abs(large[l]));
  return above == 0;
}

/// What the closed form says of one path (T: double) or eight (T: Pack). Angles count from z.
template <typename T>
struct LayeredPath {
  T sine_over_lateral;  // p / r in 1/m, p = n_i sin θ_i the same in all layers: sin θ_i = r (p / r) / n_i
  T cosine_first;       // cos θ_0 where the path leaves the source
  T cosine_last;        // cos θ in the last layer
  T spread;             // J = (sin θ_0 dθ_0) / (r dr): solid angle at the source per area of the plane, 1/m²
  T transmittance;      // product of (1 − (Rs + Rp)/2) over the interfaces, Fresnel for unpolarised light
};

/// The path that goes r sideways, r² = `squared_lateral`, through `stack` with `last_thickness` in its last layer, m.
/// With q = tan θ in the layer of lowest index n_m,
///   r(q) = q S,  S = Σ h_i n_m / s_i,  s_i = √(n_i² + (n_i² − n_m²) q²)
/// is increasing and concave, so Newton's steps from q = r / r'(0), below the root, climb to it without overshooting.
/// Then with w = 1/√(1 + q²) and D = Σ h_i n_i² / s_i³:
///   n_i cos θ_i = s_i w,   p / r = n_m w / S,   J = n_m w³ / (n_0 s_0 S D),
/// and the w cancels from Fresnel's equations. Nothing is singular at r = 0. Relative error of q below 1e-10.
/// [Snell's and Fresnel's laws; p is the ray parameter of layered media]
/// \pre last_thickness > 0, all indices > 0
template <typename T>
TACIPC_INLINE LayeredPath<T> layered_path(const LayerStack& stack, const T& last_thickness, const T& squared_lateral) {
  constexpr int kMaxSteps = 12;
  const double nm = stack.lowest_ior();
  const T lateral = root(squared_lateral);
  double reduced = 0.0;  // Σ h_i / n_i but for the last layer
  for (int i = 0; i + 1 < stack.count; ++i)
    reduced += stack.thickness_m[static_cast<std::size_t>(i)] / stack.ior[static_cast<std::size_t>(i)];
  T q = lateral / (nm * (reduced + last_thickness / stack.ior[static_cast<std::size_t>(stack.count - 1)]));
  T s[LayerStack::kMaxLayers] = {}, sum = q, slope = q;  // sum = S / n_m, slope = D
  for (int step = 0;; ++step) {
    const T qq = q * q;
    sum = qq - qq;
    slope = sum;
    for (int i = 0; i < stack.count; ++i) {
      const double n = stack.ior[static_cast<std::size_t>(i)];
      s[i] = root(n * n + (n * n - nm * nm) * qq);
      const T inverse = 1.0 / s[i];
      const T part =
          i + 1 == stack.count ? last_thickness * inverse : stack.thickness_m[static_cast<std::size_t>(i)] * inverse;
      sum += part;
      slope += n * n * part * inverse * inverse;
    }
    const T change = (lateral - q * nm * sum) / (nm * slope);
    if (step == kMaxSteps || negligible(change, q, 1e-11)) break;
    q += change;
  }
  const T w = 1.0 / root(1.0 + q * q);
  const double n0 = stack.ior[0], nl = stack.ior[static_cast<std::size_t>(stack.count - 1)];
  LayeredPath<T> path;
  path.sine_over_lateral = w / sum;
  path.cosine_first = s[0] * w / n0;
  path.cosine_last = s[stack.count - 1] * w / nl;
  path.spread = w * w * w / (n0 * s[0] * sum * slope);
  path.transmittance = w - w + 1.0;
  for (int i = 0; i + 1 < stack.count; ++i) {
    const double a = stack.ior[static_cast<std::size_t>(i)], b = stack.ior[static_cast<std::size_t>(i + 1)];
    if (a == b) continue;
    const T rs = (s[i] - s[i + 1]) / (s[i] + s[i + 1]);
    const T rp = (a * a * s[i + 1] - b * b * s[i]) / (a * a * s[i + 1] + b * b * s[i]);
    path.transmittance *= 1.0 - 0.5 * (rs * rs + rp * rp);
  }
  return path;
}

}  // namespace tacipc
