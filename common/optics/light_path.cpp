#include "common/optics/light_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tacipc {
namespace {

TACIPC_INLINE Pack positive(const Pack& x) { return choose(x, x, Pack{}); }

/// Returns the fraction of the intensity emitted at an angle of this cosine from the normal.
TACIPC_INLINE Pack emitted(const LightSample& sample, const Pack& cosine) {
  if (sample.emission == Emission::isotropic) return Pack{} + 1.0;
  if (sample.emission == Emission::lambertian) return positive(cosine);
  Pack out;
  for (int l = 0; l < kLanes; ++l) out[l] = cosine[l] > 0.0 ? std::pow(cosine[l], sample.exponent) : 0.0;
  return out;
}

/// Returns 0 if light that leaves the sample in `direction` meets the scattering ring, else 1.
TACIPC_INLINE Pack past_screen(const LightSample& sample, const Pack3& direction) {
  const Pack t = (sample.screen->z_m - sample.position_m.z()) / direction.z;
  const Pack x = sample.position_m.x() + t * direction.x, y = sample.position_m.y() + t * direction.y;
  const Pack squared = x * x + y * y, one = Pack{} + 1.0;
  const double inner = sample.screen->inner_radius_m, outer = sample.screen->outer_radius_m;
  return choose(inner * inner - squared, one, choose(squared - outer * outer, one, Pack{}));
}

TACIPC_INLINE void straight(const Pack3& point, const LightSample& sample, IncidencePack& out) {
  const Pack3 offset = {sample.position_m.x() - point.x, sample.position_m.y() - point.y,
                        sample.position_m.z() - point.z};
  const Pack squared_distance = dot(offset, offset);
  out.length = root(squared_distance);
  out.direction = (1.0 / out.length) * offset;
  const Pack cosine = -(out.direction.x * sample.normal.x() + out.direction.y * sample.normal.y() +
                        out.direction.z * sample.normal.z());
  out.irradiance = sample.weight * emitted(sample, cosine) / squared_distance;
  if (sample.screen) out.irradiance *= past_screen(sample, {-out.direction.x, -out.direction.y, -out.direction.z});
}

TACIPC_INLINE void layered(const Pack3& point, const LightSample& sample, PathStart& start, IncidencePack& out) {
  const LayerStack& stack = *sample.stack;
  const Pack dx = point.x - sample.position_m.x(), dy = point.y - sample.position_m.y();
  const Pack thickness = point.z + sample.gel_thickness_m;
  const auto path =
      layered_path<Pack>(stack, thickness, dx * dx + dy * dy, larger(2.0 * start.last - start.before, Pack{} + 1.0));
  start = {.last = path.stretch, .before = start.last};
  const Pack at_light = path.sine_over_lateral * (1.0 / stack.ior[0]);
  const Pack3 leaving = {at_light * dx, at_light * dy, path.cosine_first};
  const Pack cosine = leaving.x * sample.normal.x() + leaving.y * sample.normal.y() + leaving.z * sample.normal.z();
  const Pack in_gel = path.sine_over_lateral * (-1.0 / stack.ior[stack.count - 1]);
  out.direction = {in_gel * dx, in_gel * dy, -path.cosine_last};
  out.length = thickness * path.secant_last;
  out.irradiance = sample.weight * emitted(sample, cosine) * path.transmittance * path.spread * path.secant_last;
  if (sample.screen) out.irradiance *= past_screen(sample, leaving);
}

TACIPC_INLINE void incident(const Pack3& point, const LightSample& sample, PathStart& start, IncidencePack& out) {
  sample.stack ? layered(point, sample, start, out) : straight(point, sample, out);
}

/// Returns Smith's square root for a direction with this cosine to the normal.
TACIPC_INLINE Pack smith_root(const Coating& coating, const Pack& cosine) {
  const double a2 = coating.ggx_alpha * coating.ggx_alpha;
  return root(a2 + (1.0 - a2) * cosine * cosine);
}

/// Computes the coating's response.
/// \param facing positive n·v
/// \param shadowing Smith's square root of n·v
TACIPC_INLINE void respond(const SurfacePack& surface, const Pack3& light, const Coating& coating, const Pack& facing,
                           const Pack& shadowing, CoatingResponse& out) {
  const Pack nl = positive(dot(surface.normal, light));
  out.diffuse = std::numbers::inv_pi * nl;
  out.gloss = Pack{};
  if (coating.specular_f0 <= 0.0) return;
  // With |l| = |v| = 1, |l + v|² = 2 + 2 l·v = b, so that n·h = (n·l + n·v) / √b and h·v = √b / 2.
  const Pack b = larger(2.0 + 2.0 * dot(light, surface.view), Pack{} + 1e-30), sum = nl + facing;
  const double a2 = coating.ggx_alpha * coating.ggx_alpha, f0 = coating.specular_f0;
  const Pack spread = sum * sum * (a2 - 1.0) + b;  // D = α² b² / (π spread²)
  const Pack smith = facing * smith_root(coating, nl) + nl * shadowing;
  const Pack away = 1.0 - 0.5 * root(b), squared = away * away;
  const Pack fresnel = f0 + (1.0 - f0) * squared * squared * away;
  // G / (4 n·l n·v) = 1 / (2 (n·v √… + n·l √…)): no division by terms that vanish at grazing angles.
  const Pack lobe = nl * (0.5 * a2 * std::numbers::inv_pi) * b * b * fresnel / (spread * spread * (smith + 1e-12));
  out.gloss = choose(nl, choose(facing, lobe, Pack{}), Pack{});
}

TACIPC_CLONES void find_incidence(const Pack3& point, const LightSample& sample, PathStart& start, IncidencePack& out) {
  incident(point, sample, start, out);
}

TACIPC_CLONES void find_facing(const SurfacePack& surface, const Coating& coating, Pack& facing, Pack& shadowing) {
  facing = positive(dot(surface.normal, surface.view));
  shadowing = smith_root(coating, facing);
}

TACIPC_CLONES void find_response(const SurfacePack& surface, const Pack3& light, const Coating& coating,
                                 CoatingResponse& out) {
  const Pack facing = positive(dot(surface.normal, surface.view));
  respond(surface, light, coating, facing, smith_root(coating, facing), out);
}

/// Adds light that cannot be blocked.
/// \return false if lanes remain; then `doubtful` is filled, and `left` is greater than 0 in these lanes
TACIPC_CLONES bool add_certain(const LitPack& places, const LightSample& sample, const Coating& coating,
                               PathStart& start, CoatingResponse& sum, DoubtfulLight& doubtful, Pack& left) {
  IncidencePack light;
  incident(places.surface.point, sample, start, light);
  CoatingResponse response;
  respond(places.surface, light.direction, coating, places.facing, places.shadowing, response);
  const Pack factor = light.irradiance * places.transmittance;
  response.diffuse *= factor;
  response.gloss *= factor;
  // Light steeper than any surface around is unobstructed: everywhere on a flat face, mostly on a pressed one.
  const Pack3& w = light.direction;
  const Pack over = w.z * w.z - places.squared_steepness * (w.x * w.x + w.y * w.y);
  const Pack certain = choose(over, -w.z, Pack{}), none{};
  // Surface that faces away from the light has no gloss either.
  const Pack diffuse = choose(response.diffuse, response.diffuse, none);
  const Pack gloss = choose(response.diffuse, response.gloss, none);
  sum.diffuse += choose(certain, diffuse, none);
  sum.gloss += choose(certain, gloss, none);
  left = choose(certain, none, diffuse);
  if (all_of(left <= none)) return false;
  doubtful = {light.direction, light.length, {diffuse, gloss}};
  return true;
}

/// Adds patches of the diffuser that one LED illuminates, as lights.
void add_diffused(const Led& led, const LightSample& like, std::vector<LightSource>& sources) {
  constexpr int kRings = 4, kSectors = 48;
  const Diffuser& ring = *like.screen;
  std::vector<LightSample> patches;
  double brightest = 0.0, total = 0.0, kept = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double width = (ring.outer_radius_m - ring.inner_radius_m) / kRings;
    const double radius = ring.inner_radius_m + (i + 0.5) * width;
    for (int j = 0; j < kSectors; ++j) {
      const double azimuth = 2.0 * std::numbers::pi * (j + 0.5) / kSectors;
      const Vector3 place(radius * std::cos(azimuth), radius * std::sin(azimuth), ring.z_m);
      const Vector3 offset = place - led.position_m;
      const double distance = offset.norm(), cosine = offset.dot(led.normal) / distance;
      const double intensity = emitted(like, Pack{} + cosine)[0];
      const double irradiance = intensity * (offset.z() / distance) / (distance * distance);
      const double area = 2.0 * std::numbers::pi / kSectors * radius * width;
      LightSample patch = like;
      patch.position_m = place;
      patch.normal = Vector3::UnitZ();
      patch.emission = Emission::lambertian;
      patch.weight = led.intensity * ring.transmittance * irradiance * area * std::numbers::inv_pi;
      patch.screen.reset();
      patches.push_back(patch);
      brightest = std::max(brightest, patch.weight);
      total += patch.weight;
    }
  }
  // The light of dim patches (below 2 % of the brightest) is added to the others.
  for (const LightSample& patch : patches) kept += patch.weight >= 0.02 * brightest ? patch.weight : 0.0;
  for (LightSample& patch : patches) {
    if (patch.weight < 0.02 * brightest || patch.weight <= 0.0) continue;
    patch.weight *= total / kept;
    sources.push_back({.grid = {patch}, .in_sight = {}});
  }
}

/// Points in (−1/2, 1/2) and their weights along an edge.
struct EdgePoint {
  double at, share;
};
std::vector<EdgePoint> midpoints(int count) {
  std::vector<EdgePoint> points;
  for (int i = 0; i < count; ++i) points.push_back({(i + 0.5) / count - 0.5, 1.0 / count});
  return points;
}

/// Returns Gauss–Legendre points: roots of P_n by Newton's method, n P_n = (2n − 1) x P_{n−1} − (n − 1) P_{n−2},
/// starting from cosines near them; weights 1 / ((1 − x²) P_n'²).
std::vector<EdgePoint> gauss_points(int count) {
  std::vector<EdgePoint> points;
  for (int i = 0; i < count; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 1.0;
    for (int step = 0; step < 10; ++step) {
      double before = 1.0, value = x;
      for (int n = 2; n <= count; ++n) {
        const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
        before = value;
        value = next;
      }
      slope = count * (before - x * value) / (1.0 - x * x);
      x -= value / slope;
    }
    points.push_back({0.5 * x, 1.0 / ((1.0 - x * x) * slope * slope)});
  }
  return points;
}

/// Returns the edge vectors of an LED's rectangle.
std::array<Vector3, 2> edges_of(const Led& led) {
  Vector3 outwards = led.position_m - Vector3::UnitZ() * led.position_m.z();
  outwards -= led.normal * led.normal.dot(outwards);
  if (outwards.norm() < 1e-6 * led.position_m.norm()) outwards = led.normal.unitOrthogonal();
  const Vector3 first = outwards.normalized();
  return {led.size_m[0] * first, led.size_m[1] * led.normal.cross(first)};
}

/// Returns sample points of an LED's rectangle with the properties of `like`.
std::vector<LightSample> points_of(const Led& led, LightSample like, const std::vector<EdgePoint>& edge,
                                   const OpticalStack& layers) {
  const auto [first, second] = edges_of(led);
  std::vector<LightSample> points;
  for (const EdgePoint& a : edge) {
    for (const EdgePoint& b : edge) {
      like.position_m = led.position_m + a.at * first + b.at * second;
      like.weight = led.intensity * a.share * b.share;
      // Points of a tilted emitter have different heights, so each has its own path through the first medium.
      if (like.stack) like.stack = layers.from(std::min(like.position_m.z(), -layers.gel_thickness_m - 1e-9));
      points.push_back(like);
    }
  }
  return points;
}

}  // namespace

std::vector<LightSource> light_sources(const Sensor& sensor, int edge_samples, bool refract) {
  constexpr double kSharpLobe = 0.2;  // a narrower highlight would show the sample points
  const bool even_paint = sensor.coating.specular_f0 <= 0.0 || sensor.coating.ggx_alpha >= kSharpLobe;
  std::vector<LightSource> sources;
  const std::vector<LightGroup> groups = light_groups(sensor.leds);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const int index : groups[g].leds) {
      const Led& led = sensor.leds[index];
      const bool point = led.size_m[0] == 0.0 && led.size_m[1] == 0.0;
      LightSample sample{.normal = led.normal,
                         .emission = led.emission,
                         .exponent = led.emission_exponent,
                         .group = static_cast<int>(g),
                         .gel_thickness_m = sensor.stack.gel_thickness_m,
                         .screen = sensor.diffuser};
      if (refract && sensor.stack.refracts()) sample.stack = sensor.stack.from(led.position_m.z());
      const auto [first, second] = edges_of(led);
      const Vector3 extent = 0.5 * (first.cwiseAbs() + second.cwiseAbs());
      LightSource source{.grid = points_of(led, sample, midpoints(point ? 1 : edge_samples), sensor.stack),
                         .in_sight = {},
                         .low_m = led.position_m - extent,
                         .high_m = led.position_m + extent};
      const int fewer = edge_samples / 2 + 1;
      if (!point && fewer < edge_samples && even_paint && led.emission != Emission::cosine_power && !sensor.diffuser)
        source.in_sight = points_of(led, sample, gauss_points(fewer), sensor.stack);
      sources.push_back(std::move(source));
      if (!sensor.diffuser) continue;
      sample.position_m = led.position_m;
      if (sample.stack) sample.stack = sensor.stack.from(sensor.diffuser->z_m - 1e-9);
      add_diffused(led, sample, sources);
    }
  }
  return sources;
}

std::vector<LightSample> light_samples(const Sensor& sensor, int edge_samples, bool refract) {
  std::vector<LightSample> samples;
  for (const LightSource& source : light_sources(sensor, edge_samples, refract))
    samples.insert(samples.end(), source.grid.begin(), source.grid.end());
  return samples;
}

double least_squared_elevation(const LightSource& source, const Sensor& sensor, const Vector3& low,
                               const Vector3& high) {
  // Elevation of the arriving light falls with depth and lateral distance of the point, and with the light's closeness
  // to the gel: take the worst of each at once.
  LightSample nearest = source.grid.front();
  nearest.position_m.z() = source.high_m.z();
  if (nearest.stack) nearest.stack = sensor.stack.from(std::min(source.high_m.z(), -nearest.gel_thickness_m - 1e-9));
  if (low.z() <= source.high_m.z() || (nearest.stack && low.z() <= -nearest.gel_thickness_m)) return 0.0;
  const Vector3 away = (high - source.low_m).cwiseMax(source.high_m - low);
  Pack3 point{};
  point.x += nearest.position_m.x() + away.head<2>().norm();
  point.y += nearest.position_m.y();
  point.z += low.z();
  const IncidencePack light = light_path(point, nearest);
  const Vector3 w(light.direction.x[0], light.direction.y[0], light.direction.z[0]);
  return w.z() * w.z() / w.head<2>().squaredNorm();
}

IncidencePack light_path(const Pack3& point, const LightSample& sample, PathStart* start) {
  IncidencePack out;
  PathStart cold;
  find_incidence(point, sample, start ? *start : cold, out);
  return out;
}

CoatingResponse coating_response(const SurfacePack& surface, const Pack3& light, const Coating& coating) {
  CoatingResponse out;
  find_response(surface, light, coating, out);
  return out;
}

void prepare(const Coating& coating, LitPack& places) {
  find_facing(places.surface, coating, places.facing, places.shadowing);
}

std::uint32_t add_light(const LitPack& places, const LightSample& sample, const Coating& coating, PathStart& start,
                        CoatingResponse& sum, DoubtfulLight& doubtful) {
  Pack left;
  if (!add_certain(places, sample, coating, start, sum, doubtful, left)) return 0;
  std::uint32_t lanes = 0;
  for (int l = 0; l < kLanes; ++l) lanes |= left[l] > 0.0 ? 1u << l : 0u;
  return lanes;
}

}  // namespace tacipc
