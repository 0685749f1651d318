// Direct light at points of the membrane: direction and irradiance from each light, and the coating's response.
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
  double exponent = 1.0;                           // m of cosine_power
  double weight = 1.0;                             // fraction of the light's intensity
  int group = 0;                                   // channel of the basis image to which it adds
  std::optional<LayerStack> stack = std::nullopt;  // media from the light to the gel; absent: light travels straight
  double gel_thickness_m = 0.0;                    // set if there is a stack
  std::optional<Diffuser> screen = std::nullopt;   // a scattering ring that blocks its direct light
};

/// One emitter, represented by sample points.
struct LightSource {
  std::vector<LightSample> grid;      // points for places that may see only a part of the emitter
  std::vector<LightSample> in_sight;  // fewer points, for places that see all of it; empty: use the grid
  Vector3 low_m = Vector3::Zero(), high_m = Vector3::Zero();  // corners of a box that holds the emitter
};

/// Returns the lights of a sensor. Each LED becomes the midpoints of an edge_samples × edge_samples grid, or a single
/// point if it has no size. The rectangles are rotated so that an edge faces the sensor's axis, as packages are mounted
/// on a ring board.
/// If light and paint vary slowly over the LED (Lambertian or isotropic emission, no lobe below α 0.2), its
/// unobstructed light comes from Gauss points, ⌊edge_samples / 2⌋ + 1 along an edge: exact to a higher degree than the
/// grid.
/// If the sensor has a diffuser, each LED also illuminates patches of it, each a source of its own: a patch of area A
/// that receives E emits as a Lambertian source of intensity τ E A / π along its normal, and the direct light through
/// the ring is blocked.
std::vector<LightSource> light_sources(const Sensor& sensor, int edge_samples, bool refract = true);
/// Returns the grids of all lights in one list.
std::vector<LightSample> light_samples(const Sensor& sensor, int edge_samples, bool refract = true);

/// Returns the square of the smallest tangent of elevation over the plane z = 0 at which light from any point of the
/// emitter arrives in the gel, at points between `low` and `high`; 0 if it may come from below.
double least_squared_elevation(const LightSource& source, const Sensor& sensor, const Vector3& low,
                               const Vector3& high);

/// Eight illuminated points of the membrane.
struct SurfacePack {
  Pack3 point;          // m
  Pack3 normal;         // unit, towards the inside of the gel
  Pack3 view;           // unit, towards the origin of the camera's ray
  Pack3 shadow_origin;  // origin of rays to the lights
};

/// Light from one sample that arrives at eight points.
struct IncidencePack {
  Pack3 direction;  // unit, from the point towards the light, in the gel
  Pack length;      // length of the path in the gel, m; anything that blocks it there casts a shadow
  Pack irradiance;  // irradiance of a surface that faces `direction`, per unit of intensity along the light's normal,
                    // 1/m²
};

/// Start values for the search of a path, extrapolated from the last two packs of a row: they are so close that one
/// step suffices.
struct PathStart {
  Pack last = Pack{} + 1.0, before = Pack{} + 1.0;  // values of LayeredPath::stretch
};

/// Computes the light of one sample. Straight path: E = weight · I(θ) / d², I(θ) = cos θ, 1 or cos^m θ (zero behind the
/// light). Through layers: E = weight · I(θ_0) T J / cos θ_gel from layered_path(), with the gel as thick as the
/// point's distance from its back.
/// \param start kept from one pack of a row to the next, for the same sample
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

/// Eight points with the quantities that do not depend on the light sample.
struct LitPack {
  SurfacePack surface;
  Pack transmittance;      // towards the camera; 0: no light is computed
  Pack squared_steepness;  // square of the horizon's steepness (horizon.h): steeper light is not blocked
  Pack facing, shadowing;  // factors set by prepare()
};
/// Sets `facing` and `shadowing`.
void prepare(const Coating& coating, LitPack& places);

/// Light of one sample whose path to the surface may be blocked.
struct DoubtfulLight {
  Pack3 direction;
  Pack length;
  CoatingResponse response;
};

/// Adds the light of one sample that eight points reflect to the camera, in lanes where nothing can block it. One
/// function does path and coating, because together they take most of a picture's time.
/// \return bits of the other illuminated lanes, whose light is in `doubtful`
std::uint32_t add_light(const LitPack& places, const LightSample& sample, const Coating& coating, PathStart& start,
                        CoatingResponse& sum, DoubtfulLight& doubtful);

}  // namespace tacipc
