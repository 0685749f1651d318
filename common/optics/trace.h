// What the camera sees of the membrane, light by light: radiance, depth, normals, indentation, what touches it. No
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

/// The rays of a picture in the order they were traced, for measuring what tracing costs.
struct RayLog {
  std::vector<RayPacket> camera = {};
  std::vector<RayPacket> shadow = {};
};

struct TraceSettings {
  int subpixels = 2;      // rays per pixel edge, on a fixed grid (box filter)
  int led_samples = 3;    // points per edge of a light with size
  bool refract = true;    // at the sensor's layers, if it has any; else straight rays
  int indirect_rays = 0;  // per vertex, for light reflected by the membrane (indirect.h); 0: none
  RayLog* log = nullptr;  // filled on one thread only
};

/// What a press says of each vertex of the membrane.
struct SurfaceFields {
  Positions traction_pa = {};              // force on the gel per deformed area, S; no rows: not known
  std::vector<ContactState> contact = {};  // empty: not known
};

/// Pixels no ray of which meets the membrane are NaN in depth, normal, indentation and traction, and dark in the basis.
struct TraceResult {
  FloatImage basis = {};   // one channel per light group: its radiance from a Lambert coating of albedo 1, intensities
                           // as in the file and colour 1, 1/m²
  FloatImage gloss = {};   // alike from the coating's lobe; no channels without one
  FloatImage marked = {};  // the part of `basis` that falls on markers; no channels without printed markers
  FloatImage marked_gloss = {};
  FloatImage coverage = {};     // share of the pixel's rays that meet a marker; no channels without printed markers
  FloatImage indirect = {};     // alike: what the membrane sends to itself, at albedo 1 both times; no channels without
  FloatImage depth = {};        // m along +z from the camera
  FloatImage normal = {};       // unit, outward normal of the front face in S: (0, 0, 1) where it is flat
  FloatImage indentation = {};  // m the seen material has moved along −z, > 0 into the gel
  FloatImage traction = {};     // Pa on the gel, S; no channels if not known
  ByteImage contact = {};       // of most of the pixel's rays: a ContactState; the higher one of two as many
  ByteImage segment = {};       // alike: a Segment
  std::int64_t rays = 0;
  std::int64_t nudged_rays = 0;   // slipped through a vertex and hit after a retry with an offset of 1e-6
  std::int64_t outside_rays = 0;  // pass beside the membrane: the window is larger than the gel
};

/// Radiance of light group g, direct light on the coating seen from inside:
///   B_g = T Σ_s E_s f(n, w_s, v) V_s   over the samples s of its lights,
/// E_s from light_path, f from coating_response, n the interpolated normal (towards the inside), T the Fresnel
/// transmittance towards the camera, V_s = 0 where the membrane blocks the path inside the gel.
/// Rows are traced in parallel; the result does not depend on the number of threads.
/// \throw DataError if a ray inside the membrane's outline slips through it even after a retry.
/// \pre `scene` holds the membrane's triangles where they are now
TraceResult trace(const RayScene& scene, const Membrane& membrane, const Sensor& sensor, const TraceSettings& settings,
                  const SurfaceFields& fields = {});

/// Linear image in three channels: L_c = albedo_c Σ_g rgb_gc B_g + ambient_c. Light is additive, so recolouring the
/// lights needs no rays.
FloatImage color_image(const FloatImage& basis, const Sensor& sensor);
/// The same with the coating's lobe, light reflected by the membrane (times albedo once more) and, if wanted, the
/// printed markers: where they are, their albedo and no lobe.
FloatImage color_image(const TraceResult& result, const Sensor& sensor, bool with_markers);

/// Image of one light group alone in white, without markers and ambient: in channel c albedo_c B_g + S_g + albedo_c²
/// I_g. The groups' images times their colours, and the ambient, are the whole image.
FloatImage group_image(const TraceResult& result, const Sensor& sensor, std::size_t group);

/// Share of the image's light reflected by the membrane (0 where it was not traced).
double indirect_share(const TraceResult& result, const Sensor& sensor);

}  // namespace tacipc
