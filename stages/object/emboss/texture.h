// Textures without outlines: heights in [0, 1] over the plane of the face.
#pragma once

#include <cstdint>
#include <functional>

#include "stages/object/emboss/outline.h"

namespace tacipc {

/// Height as a fraction of the relief, in [0, 1], at a point of the face in metres.
using Height = std::function<double(const Vector2&)>;

/// Gradient noise in [−1, 1], zero at whole coordinates, C²: unit gradients of random direction at the lattice points,
/// blended by 6t⁵ − 15t⁴ + 10t³ [Perlin2002], scaled by √2.
double gradient_noise(const Vector2& p, std::uint64_t seed, std::uint64_t stream);

/// Stone: ½ + contrast/2 · Σ 2⁻ᵒ noise(2ᵒ p / size) / Σ 2⁻ᵒ over the octaves, held in [0, 1] by a smooth step.
double stone_height(const Vector2& p, double size_m, int octaves, double contrast, std::uint64_t seed);

/// Plain weave of two families of strands: at each crossing one runs over the other, alternating. The section of a
/// strand is a parabola over `fill` of the pitch.
double weave_height(const Vector2& p, double pitch_m, double fill);

/// Ridges of a fingertip: ½ + ½ cos(2π φ), where φ is the radius of an oval whorl over the pitch. Before, noise of size
/// `bend_size` bends the plane by up to `bend`.
double ridges_height(const Vector2& p, double pitch_m, double bend_m, double bend_size_m, std::uint64_t seed);

}  // namespace tacipc
