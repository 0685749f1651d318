// From points of the membrane to a light: where its light comes from and how much of it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/types.h"
#include "common/sensor/layered_path.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// One quadrature point of a light.
struct LightSample {
  Vector3 position_m = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();  // unit, the direction of its maximum
  Emission emission = Emission::lambertian;
  double exponent = 1.0;                           // of cosine_power
  double weight = 1.0;                             // share of the light's intensity
  int group = 0;                                   // channel of the basis it adds to
  std::optional<LayerStack> stack = std::nullopt;  // media from here to the gel; absent: light goes straight
  double gel_thickness_m = 0.0;                    // where there is a stack
  std::optional<Diffuser> screen = std::nullopt;   // a scattering ring that its direct light does not pass
};

/// One emitter as points.
struct LightSource {
  std::vector<LightSample> grid;      // for places that may see a part of it only
  std::vector<LightSample> in_sight;  // fewer: enough where all of it is seen; none: the grid is
  Vector3 low_m = Vector3::Zero(), high_m = Vector3::Zero();  // corners of a box that holds the emitter
};

/// Each LED as the midpoints of an edge_samples × edge_samples grid, or as a single point if it has no size. The
/// rectangles are turned so that an edge faces the sensor's axis, as packages are mounted on a ring board.
/// Where light and paint vary slowly over the LED (Lambertian or isotropic emission, no lobe below α 0.2), its light in
/// full sight comes from Gauss's points, ⌊edge_samples / 2⌋ + 1 along an edge: exact to a higher degree than the
/// grid's. Where the sensor has a diffuser, each LED also lights patches of it, each a source of its own: a patch of
/// area A that receives E emits as a Lambert source of intensity τ E A / π along its normal, and the direct light
/// through the ring is cut off.
std::vector<LightSource> light_sources(const Sensor& sensor, int edge_samples, bool refract = true);
/// The grids of all.
std::vector<LightSample> light_samples(const Sensor& sensor, int edge_samples, bool refract = true);

/// Square of the least tangent of elevation over the plane z = 0 at which light of any of the emitter's points arrives
/// in the gel, at points between `low` and `high`; 0 if it may come from below.
double least_squared_elevation(const LightSource& source, const Sensor& sensor, const Vector3& low,
                               const Vector3& high);

/// Eight places of the membrane that wait for light.
struct SurfacePack {
  Pack3 point;          // m
  Pack3 normal;         // unit, towards the inside of the gel
  Pack3 view;           // unit, towards where the camera's ray comes from
  Pack3 shadow_origin;  // where rays to the lights start
};

/// Light that arrives at them from one light sample.
struct IncidencePack {
  Pack3 direction;  // unit, from the point towards the light, in the gel
  Pack length;      // of the path in the gel, m: what blocks it there makes shadow
  Pack irradiance;  // on a surface that faces `direction`, per unit of intensity along the light's normal, 1/m²
};

/// Where the search for a path begins: from those of the last two packs of a row it leads so near that one step is
/// enough.
struct PathStart {
  Pack last = Pack{} + 1.0, before = Pack{} + 1.0;  // stretch of layered_path
};

/// Straight path: E = weight · I(θ) / d², I(θ) = cos θ, 1 or cos^m θ (nothing behind the light). Through layers:
/// E = weight · I(θ_0) T J / cos θ_gel of layered_path, where the gel is as thick as the point lies before its back.
/// `start`: kept from one pack of a row to the next, for the same sample.
IncidencePack light_path(const Pack3& point, const LightSample& sample, PathStart* start = nullptr);

/// Radiance towards `view` per unit of irradiance on a facing surface, for the two parts of the coating:
///   diffuse: max(0, n·l) / π (albedo 1);  glossy: max(0, n·l) D F G / (4 n·l n·v), GGX with
///   D = α² / (π ((n·h)² (α² − 1) + 1)²), Smith's height-correlated G, F = f0 + (1 − f0)(1 − h·v)⁵
/// [Walter et al. 2007; Heitz 2014]. The glossy part is zero without a lobe.
struct CoatingResponse {
  Pack diffuse;
  Pack gloss;
};
CoatingResponse coating_response(const SurfacePack& surface, const Pack3& light, const Coating& coating);

/// Eight places with what all light samples have in common there.
struct LitPack {
  SurfacePack surface;
  Pack transmittance;      // towards the camera; 0 where no light is wanted
  Pack squared_steepness;  // light that is steeper meets nothing on its way (horizon.h)
  Pack facing, shadowing;  // of prepare(…)
};
void prepare(const Coating& coating, LitPack& places);

/// Light of one sample on its way to the camera, for what is not yet known to arrive.
struct DoubtfulLight {
  Pack3 direction;
  Pack length;
  CoatingResponse response;
};

/// Adds what one sample sends to eight places and these reflect to the camera, where nothing can be in its way. The
/// other lit lanes come back as bits, with their light in `doubtful`. In one function, because together path and paint
/// take most of the time of a picture.
std::uint32_t add_light(const LitPack& places, const LightSample& sample, const Coating& coating, PathStart& start,
                        CoatingResponse& sum, DoubtfulLight& doubtful);

}  // namespace tacipc
