// What the camera sees of the membrane, light by light: radiance, depth, normals, indentation. No random numbers.
#pragma once

#include <cstdint>

#include "common/image.h"
#include "common/sensor.h"
#include "stages/render/membrane.h"

namespace tacipc {

struct TraceSettings {
  int subpixels = 2;    // rays per pixel edge, on a fixed grid (box filter)
  int led_samples = 3;  // points per edge of a light with size
};

/// Pixels no ray of which meets the membrane are NaN in depth, normal and indentation, and dark in the basis.
struct TraceResult {
  FloatImage basis;        // one channel per light: radiance under that light alone at unit intensity and albedo, 1/m²
  FloatImage depth;        // m along +z from the camera
  FloatImage normal;       // unit, outward normal of the front face in S: (0, 0, 1) where it is flat
  FloatImage indentation;  // m the seen material has moved along −z, > 0 into the gel
  std::int64_t rays = 0;
  std::int64_t nudged_rays = 0;   // slipped through a vertex and hit after a nudge of 1e-6
  std::int64_t outside_rays = 0;  // pass beside the membrane: the window is larger than the gel
};

/// Radiance of light l, direct light on a Lambert coating seen from inside:
///   B_l = 1/π Σ_s E_s max(0, n · w_s) V_s   over the samples s of the light,
/// E_s from light_path, n the interpolated normal (towards the inside), V_s = 0 where the membrane blocks the way.
/// Rows are traced in parallel; the result does not depend on the number of threads.
/// \throw DataError if a ray inside the membrane's outline slips through it even after a nudge.
TraceResult trace(const Membrane& membrane, const Sensor& sensor, const TraceSettings& settings);

/// Linear image in three channels: L_c = albedo_c Σ_l rgb_lc B_l + ambient_c. Light is additive, so recolouring the
/// lights needs no rays.
FloatImage color_image(const FloatImage& basis, const Sensor& sensor);

}  // namespace tacipc
