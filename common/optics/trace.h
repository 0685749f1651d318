// Traces what the camera sees of the membrane, light by light: radiance, depth, normals, indentation, contact. Uses no
// random numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "common/image/image.h"
#include "common/optics/membrane.h"
#include "common/optics/ray_scene.h"
#include "common/sample/contact_state.h"
#include "common/sample/segment.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Rays of a picture in the order of tracing, for measurements of its cost.
struct RayLog {
  std::vector<RayPacket> camera = {};
  std::vector<RayPacket> shadow = {};
};

/// Settings of trace().
struct TraceSettings {
  int subpixels = 2;      // rays per pixel edge, on a fixed grid (box filter)
  int led_samples = 3;    // points per edge of an extended light
  bool refract = true;    // refract at the sensor's layers, if it has any; false: straight rays
  int indirect_rays = 0;  // rays per vertex for light reflected by the membrane (indirect.h); 0: none
  RayLog* log = nullptr;  // filled on one thread only
};

/// Fields of a press run at each vertex of the membrane.
struct SurfaceFields {
  Positions traction_pa = {};              // force on the gel per deformed area, frame S; no rows: unknown
  std::vector<ContactState> contact = {};  // contact state; empty: unknown
};

/// Result of trace(). A pixel whose rays all miss the membrane is NaN in depth, normal, indentation and traction, and
/// dark in the basis.
struct TraceResult {
  FloatImage basis = {};   // one channel per light group: radiance from a Lambertian coating of albedo 1, with
                           // intensities as in the file and colour 1, 1/m²
  FloatImage gloss = {};   // one channel per light group: radiance from the coating's lobe; no channels without a lobe
  FloatImage marked = {};  // part of `basis` that falls on markers; no channels without printed markers
  FloatImage marked_gloss = {};
  FloatImage coverage = {};     // fraction of the pixel's rays that meet a marker; no channels without printed markers
  FloatImage indirect = {};     // one channel per light group: light reflected by the membrane, at albedo 1 for both
                                // reflections; no channels if not traced
  FloatImage depth = {};        // m along +z from the camera
  FloatImage normal = {};       // unit, outward normal of the front face in S: (0, 0, 1) on the flat front
  FloatImage indentation = {};  // m, displacement of the visible material point along −z, > 0 into the gel
  FloatImage traction = {};     // Pa on the gel, frame S; no channels if unknown
  ByteImage contact = {};       // a ContactState, by majority of the pixel's rays; the higher one of a tie
  ByteImage segment = {};       // a Segment, by majority
  std::int64_t rays = 0;
  std::int64_t nudged_rays = 0;   // rays that slipped through a vertex and hit after a retry with an offset of 1e-6
  std::int64_t outside_rays = 0;  // rays that pass next to the membrane, where the field of view exceeds the gel
};

/// Computes the radiance of each light group g, from direct light on the coating seen from inside:
///   B_g = T Σ_s E_s f(n, w_s, v) V_s   over the samples s of its lights,
/// with E_s from light_path, f from coating_response, and n the interpolated normal (towards the inside). T is the
/// Fresnel transmittance towards the camera; V_s is 0 if the membrane blocks the path inside the gel, else 1. Rows are
/// traced in parallel; the result does not depend on the number of threads.
/// \pre `scene` holds the membrane's triangles at their current positions
/// \throw DataError if a ray inside the membrane's outline slips through it even after a retry
TraceResult trace(const RayScene& scene, const Membrane& membrane, const Sensor& sensor, const TraceSettings& settings,
                  const SurfaceFields& fields = {});

/// Returns the linear image in three channels: L_c = albedo_c Σ_g rgb_gc B_g + ambient_c. Light is additive, so that
/// new colours of the lights need no rays.
FloatImage color_image(const FloatImage& basis, const Sensor& sensor);
/// Returns the linear image with the coating's lobe, light reflected by the membrane (times albedo once more) and, if
/// wanted, the printed markers, with their own albedo and without lobe.
FloatImage color_image(const TraceResult& result, const Sensor& sensor, bool with_markers);

/// Returns the image of one light group in white, without markers and ambient: albedo_c B_g + S_g + albedo_c² I_g in
/// channel c. The whole image is the sum of the groups' images times their colours, plus the ambient.
FloatImage group_image(const TraceResult& result, const Sensor& sensor, std::size_t group);

/// Returns the fraction of the image's light that the membrane reflected (0 if not traced).
double indirect_share(const TraceResult& result, const Sensor& sensor);

}  // namespace tacipc
