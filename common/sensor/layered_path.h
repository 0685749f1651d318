// Light through planar layers: the one path between two points and the fraction of light that arrives, in closed form.
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "common/base/simd.h"

namespace tacipc {

/// Layers across z from a source (layer 0) to a receiver (the last), each with thickness and refractive index. The last
/// thickness is for a receiver at z = 0; paths to other receivers give their own.
struct LayerStack {
  static constexpr int kMaxLayers = 8;
  std::array<double, kMaxLayers> thickness_m{};
  std::array<double, kMaxLayers> ior{};
  int count = 0;

  /// Appends a layer.
  void add(double thickness, double index) {
    assert(count < kMaxLayers);
    if (count > 0) reduced_m += thickness_m[count - 1] / ior[count - 1];
    lowest_ior = count == 0 || index < lowest_ior ? index : lowest_ior;
    thickness_m[count] = thickness;
    ior[count++] = index;
  }
  double lowest_ior = 1.0;
  double reduced_m = 0.0;  // Σ h_i / n_i over all layers but the last
};

TACIPC_INLINE double root(double x) { return std::sqrt(x); }
TACIPC_INLINE Pack root(const Pack& x) {
  Pack out;
  for (int l = 0; l < kLanes; ++l) out[l] = std::sqrt(x[l]);
  return out;
}
TACIPC_INLINE double larger(double a, double b) { return a > b ? a : b; }
/// Returns whether |small| ≤ bound · |large| in every lane.
TACIPC_INLINE bool negligible(double small, double large, double bound) {
  return std::abs(small) <= bound * std::abs(large);
}
TACIPC_INLINE bool negligible(const Pack& small, const Pack& large, double bound) {
  return all_of(larger(small, -small) <= bound * larger(large, -large));
}

/// Path through the layers: one (T: double) or eight (T: Pack). Angles count from z.
template <typename T>
struct LayeredPath {
  T sine_over_lateral;  // p / r in 1/m; p = n_i sin θ_i is the same in all layers: sin θ_i = r (p / r) / n_i
  T cosine_first;       // cos θ_0 at the source
  T cosine_last;        // cos θ in the last layer
  T secant_last;        // 1 / cos θ in the last layer
  T spread;             // J = (sin θ_0 dθ_0) / (r dr): solid angle at the source per area of the plane, 1/m²
  T transmittance;      // product of (1 − (Rs + Rp)/2) over the interfaces, Fresnel for unpolarised light
  T stretch;            // q of the path over q at small angles, ≥ 1: start value for the search of a nearby path
};

/// The terms s_i, and the sums over layers from which r(q) and its derivatives follow.
template <int kCount, typename T>
struct LayerSums {
  static constexpr int kRoom = kCount > 0 ? kCount : LayerStack::kMaxLayers;
  T s[kRoom], inverse[kRoom];
  T sum, slope, bend;  // S / n_m = Σ h_i / s_i;  D = Σ h_i n_i² / s_i³;  Σ h_i n_i² (n_i² − n_m²) / s_i⁵
};

/// Returns n_i² − n_m²; 0 for layers of the lowest index, whose s_i is n_i.
TACIPC_INLINE double over_lowest(const LayerStack& stack, int i) {
  const double n = stack.ior[i];
  return n * n - stack.lowest_ior * stack.lowest_ior;
}

/// Computes s_i and 1 / s_i at q², with one division for all layers.
template <int kCount, typename T>
TACIPC_INLINE void solve_layers(const LayerStack& stack, int count, const T& qq, LayerSums<kCount, T>& out) {
  T product = T{} + 1.0;
  T before[LayerSums<kCount, T>::kRoom];
  for (int i = 0; i < count; ++i) {
    const double n = stack.ior[i], over = over_lowest(stack, i);
    out.s[i] = over == 0.0 ? T(T{} + n) : root(n * n + over * qq);
    before[i] = product;
    product *= out.s[i];
  }
  T inverse = 1.0 / product;
  for (int i = count - 1; i >= 0; --i) {
    out.inverse[i] = inverse * before[i];
    inverse *= out.s[i];
  }
}

/// Updates s_i and 1 / s_i after a change of q² so small that four terms of the square roots' series suffice: with ε =
/// (n_i² − n_m²) Δq² / s_i² below 2e-4, the remainder is below 1e-15.
template <int kCount, typename T>
TACIPC_INLINE void shift_layers(const LayerStack& stack, int count, const T& change, LayerSums<kCount, T>& out) {
  for (int i = 0; i < count; ++i) {
    const double over = over_lowest(stack, i);
    if (over == 0.0) continue;
    const T e = over * change * out.inverse[i] * out.inverse[i];
    out.s[i] *= 1.0 + e * (0.5 - e * (0.125 - e * 0.0625));
    out.inverse[i] *= 1.0 - e * (0.5 - e * (0.375 - e * 0.3125));
  }
}

/// Computes the sums over layers.
template <int kCount, typename T>
TACIPC_INLINE void sum_layers(const LayerStack& stack, int count, const T& last_thickness, LayerSums<kCount, T>& out) {
  out.sum = out.slope = out.bend = T{};
  for (int i = 0; i < count; ++i) {
    const double n = stack.ior[i];
    const T& inverse = out.inverse[i];
    const T part = i + 1 == count ? T(last_thickness * inverse) : T(stack.thickness_m[i] * inverse);
    const T squared = inverse * inverse, steep = n * n * part * squared;
    out.sum += part;
    out.slope += steep;
    out.bend += over_lowest(stack, i) * steep * squared;
  }
}

/// Computes the path; see layered_path().
/// \tparam kCount number of layers if known at compile time; 0: the stack's number
template <int kCount, typename T>
TACIPC_INLINE LayeredPath<T> path_through(const LayerStack& stack, const T& last_thickness, const T& squared_lateral,
                                          const T& stretch) {
  constexpr int kMaxSteps = 12;
  // The error after such a step is of the order of its cube, which is below the promised accuracy, so the step ends the
  // search.
  constexpr double kLastStep = 5e-5, kAtRoot = 1e-11;
  const int count = kCount > 0 ? kCount : stack.count;
  const double nm = stack.lowest_ior, n0 = stack.ior[0], nl = stack.ior[count - 1];
  const T& rr = squared_lateral;
  const T height = nm * (stack.reduced_m + last_thickness * (1.0 / nl));  // r / q of rays along z
  T k = stretch / height;                                                 // q / r
  LayerSums<kCount, T> at;
  solve_layers<kCount, T>(stack, count, k * k * rr, at);
  for (int step = 0;; ++step) {
    sum_layers<kCount, T>(stack, count, last_thickness, at);
    const T missing = 1.0 / nm - k * at.sum, per_step = k * at.slope;  // Newton's step over k is their ratio
    if (step == kMaxSteps || negligible(missing, per_step, kAtRoot)) break;
    const T squared = at.slope * at.slope;
    const T change = missing * at.slope / larger(squared - 1.5 * missing * k * rr * at.bend, 0.5 * squared);
    if (negligible(missing, per_step, kLastStep)) {
      shift_layers<kCount, T>(stack, count, (2.0 * k + change) * change * rr, at);
      k += change;
      sum_layers<kCount, T>(stack, count, last_thickness, at);
      break;
    }
    k += change;
    solve_layers<kCount, T>(stack, count, k * k * rr, at);
  }

  T passed = T{} + 1.0, of = T{} + 1.0;
  for (int i = 0; i + 1 < count; ++i) {
    const double a = stack.ior[i], b = stack.ior[i + 1];
    if (a == b) continue;
    // 1 − (rs² + rp²)/2 = 2 s s' (1/x² + a² b²/y²) with x, y the denominators of rs and rp
    const T x = at.s[i] + at.s[i + 1], y = a * a * at.s[i + 1] + b * b * at.s[i];
    const T xx = x * x, yy = y * y;
    passed *= 2.0 * at.s[i] * at.s[i + 1] * (yy + a * a * b * b * xx);
    of *= xx * yy;
  }
  const T ww = 1.0 + k * k * rr, secant = root(ww);  // 1 / w
  const T steep = ww * at.s[0] * at.slope, all = steep * secant * at.sum;
  const T inverse = 1.0 / (all * of), shared = inverse * of;  // one division for all results
  LayeredPath<T> path;
  const T w = shared * steep * at.sum;
  path.sine_over_lateral = nm * k * w;  // computed from q, not from S: at grazing angles an error of q does not matter
  path.cosine_first = at.s[0] * w * (1.0 / n0);
  path.cosine_last = at.s[count - 1] * w * (1.0 / nl);
  path.secant_last = nl * secant * at.inverse[count - 1];
  path.spread = (1.0 / n0) * shared;
  path.transmittance = passed * inverse * all;
  path.stretch = k * height;
  return path;
}

/// Computes the path with lateral distance r, r² = `squared_lateral`, through `stack` with `last_thickness` (m) in its
/// last layer. With q = tan θ in the layer of lowest index n_m,
///   r(q) = q S,  S = Σ h_i n_m / s_i,  s_i = √(n_i² + (n_i² − n_m²) q²)
/// is increasing and concave. Halley's method (Newton's, corrected by the second derivative) finds the root, starting
/// from q = r / r'(0) times `stretch`: 1, or a guess; the result does not depend on it. Then with w = 1/√(1 + q²) and D
/// = Σ h_i n_i² / s_i³:
///   n_i cos θ_i = s_i w,   p / r = n_m q w / r,   J = n_m w³ / (n_0 s_0 S D),
/// and w cancels from Fresnel's equations. Nothing is singular at r = 0. The relative error of q is below 1e-10.
/// [Snell's and Fresnel's laws; p is the ray parameter of layered media]
/// \pre last_thickness > 0, all indices > 0
template <typename T>
TACIPC_INLINE LayeredPath<T> layered_path(const LayerStack& stack, const T& last_thickness, const T& squared_lateral,
                                          const T& stretch = T{} + 1.0) {
  switch (stack.count) {  // usual numbers of layers: with a constant count, values stay in registers
    case 2: return path_through<2>(stack, last_thickness, squared_lateral, stretch);
    case 3: return path_through<3>(stack, last_thickness, squared_lateral, stretch);
    default: return path_through<0>(stack, last_thickness, squared_lateral, stretch);
  }
}

}  // namespace tacipc
