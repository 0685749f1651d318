#include "common/optics/trace.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "common/base/error.h"
#include "common/optics/camera_hits.h"
#include "common/optics/horizon.h"
#include "common/optics/indirect.h"
#include "common/optics/light_path.h"
#include "common/sensor/camera_model.h"

namespace tacipc {
namespace {

static_assert(RayPacket::kSize == kLanes);

struct RowCounts {
  HitCounts rays;
  std::optional<std::array<int, 2>> fallen_pixel;
};

/// Sums over the rays of one pixel.
struct PixelSums {
  double depth = 0.0, indentation = 0.0;
  Vector3 normal = Vector3::Zero(), traction = Vector3::Zero();
  int hits = 0, on_marker = 0;
  std::array<int, 5> segments{};
  std::array<int, 3> contacts{};
};

/// Returns the class with the most rays; of a tie, the higher one.
template <std::size_t N>
std::uint8_t most(const std::array<int, N>& counts) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < N; ++i) {
    if (counts[i] >= counts[best]) best = i;
  }
  return static_cast<std::uint8_t>(best);
}

class RowTracer {
 public:
  RowTracer(const RayScene& scene, const Membrane& membrane, const Sensor& sensor, const TraceSettings& settings,
            const SurfaceFields& fields)
      : scene_(scene),
        membrane_(membrane),
        sensor_(sensor),
        fields_(fields),
        horizon_(membrane),
        camera_(sensor.camera, sensor.stack, settings.refract),
        sources_(light_sources(sensor, settings.led_samples, settings.refract)),
        subpixels_(settings.subpixels),
        groups_(light_groups(sensor.leds).size()),
        log_(settings.log) {
    const Vector3 low = membrane.positions.colwise().minCoeff(), high = membrane.positions.colwise().maxCoeff();
    for (const LightSource& source : sources_) {
      sample_count_ += source.grid.size() + source.in_sight.size();
      if (source.in_sight.empty()) continue;
      const double least = least_squared_elevation(source, sensor, low, high);
      least_elevation_ = least_elevation_ ? std::min(*least_elevation_, least) : least;
    }
    if (settings.indirect_rays == 0) return;
    const VertexLight direct = direct_vertex_light(scene, membrane, sensor, settings.led_samples, settings.refract);
    indirect_ = gather_indirect(scene, membrane, direct, sensor, settings.indirect_rays, settings.refract);
  }

  RowCounts trace_row(int row, TraceResult& out) const {
    const FlushDenormals flush;
    RowCounts counts;
    const int width = sensor_.camera.width_px;
    std::vector<PixelSums> pixels(width);
    const std::size_t channels = static_cast<std::size_t>(width) * groups_;
    std::vector<double> diffuse(channels), gloss(channels), marked(channels), marked_gloss(channels),
        indirect(channels);
    std::vector<CoatingResponse> light(groups_);
    for (int j = 0; j < subpixels_; ++j) {
      std::vector<PathStart> starts(sample_count_);
      for (int first = 0; first < width * subpixels_; first += kLanes) {
        Pack columns;
        for (int l = 0; l < kLanes; ++l) columns[l] = (first + l + 0.5) / subpixels_;
        const CameraRays rays = camera_.rays(columns, row + (j + 0.5) / subpixels_);
        RayPacket packet;
        const int count = std::min(kLanes, width * subpixels_ - first);
        const auto [hits, fallen] = find_hits(scene_, membrane_, rays, count, packet, counts.rays);
        if (log_) log_->camera.push_back(packet);
        if (fallen && !counts.fallen_pixel) counts.fallen_pixel = {(first + *fallen) / subpixels_, row};
        gather_light(hits, rays, starts, light);
        for (int l = 0; l < kLanes && first + l < width * subpixels_; ++l) {
          const auto pixel = static_cast<std::size_t>((first + l) / subpixels_);
          const auto& hit = hits[l];
          if (!hit) {
            ++pixels[pixel].segments[static_cast<std::size_t>(Segment::beside)];
            continue;
          }
          const bool on_marker = add_geometry(*hit, pixels[pixel]);
          for (std::size_t g = 0; g < groups_; ++g) {
            diffuse[pixel * groups_ + g] += light[g].diffuse[l];
            gloss[pixel * groups_ + g] += light[g].gloss[l];
            if (indirect_.rows() > 0) indirect[pixel * groups_ + g] += rays.transmittance[l] * indirect_at(*hit, g);
            if (!on_marker) continue;
            marked[pixel * groups_ + g] += light[g].diffuse[l];
            marked_gloss[pixel * groups_ + g] += light[g].gloss[l];
          }
        }
      }
    }
    const double rays_per_pixel = subpixels_ * subpixels_;
    const auto write = [&](const std::vector<double>& from, FloatImage& image) {
      if (image.channels == 0) return;
      const std::size_t start = static_cast<std::size_t>(row) * channels;
      for (std::size_t i = 0; i < channels; ++i) image.pixels[start + i] = static_cast<float>(from[i] / rays_per_pixel);
    };
    write(diffuse, out.basis);
    write(gloss, out.gloss);
    write(marked, out.marked);
    write(marked_gloss, out.marked_gloss);
    write(indirect, out.indirect);
    for (int column = 0; column < width && out.coverage.channels == 1; ++column) {
      const double share = pixels[column].on_marker / rays_per_pixel;
      out.coverage.at(column, row, 0) = static_cast<float>(share);
    }
    for (int column = 0; column < width; ++column) write_geometry(pixels[column], column, row, out);
    return counts;
  }

 private:
  using Hits = std::array<std::optional<SurfaceHit>, kLanes>;

  /// Adds the light from every source that the hits reflect to the camera.
  /// \param starts path starts of the previous pack
  void gather_light(const Hits& hits, const CameraRays& rays, std::vector<PathStart>& starts,
                    std::vector<CoatingResponse>& light) const {
    std::ranges::fill(light, CoatingResponse{});
    LitPack places{};
    SurfacePack& surface = places.surface;
    bool lit = false;
    for (int l = 0; l < kLanes; ++l) {
      // Empty lanes behave like a point of the flat face.
      const SurfaceHit* hit = hits[l] ? &*hits[l] : nullptr;
      if (hit && hit->from_inside) {
        lit = true;
        places.transmittance[l] = rays.transmittance[l];
      }
      put(surface.point, l, hit ? hit->point : Vector3(0.0, 0.0, 0.0));
      put(surface.normal, l, hit ? hit->inner_normal : Vector3(0.0, 0.0, -1.0));
      put(surface.shadow_origin, l, hit ? hit->shadow_origin : Vector3(0.0, 0.0, 0.0));
      put(surface.view, l, hit ? Vector3(-lane_of(rays.direction, l)) : Vector3(0.0, 0.0, -1.0));
      const double steepness = hit ? horizon_.steepness(hit->point.x(), hit->point.y()) : 0.0;
      places.squared_steepness[l] = steepness * steepness;
    }
    if (!lit) return;
    prepare(sensor_.coating, places);
    // Points above whose surroundings nothing rises steeply see every light completely, and need fewer sample points.
    LitPack open = places;
    bool any_open = false, any_other = false;
    for (int l = 0; l < kLanes; ++l) {
      if (places.transmittance[l] == 0.0) continue;
      const bool is_open = least_elevation_ && places.squared_steepness[l] < *least_elevation_;
      (is_open ? any_open : any_other) = true;
      (is_open ? places : open).transmittance[l] = 0.0;
    }
    PathStart* start = starts.data();
    for (const LightSource& source : sources_) {
      const bool fewer = !source.in_sight.empty();
      if (any_open)
        add_samples(open, fewer ? source.in_sight : source.grid, start + (fewer ? source.grid.size() : 0), light);
      if (any_other) add_samples(places, source.grid, start, light);
      start += source.grid.size() + source.in_sight.size();
    }
  }

  void add_samples(const LitPack& places, const std::vector<LightSample>& samples, PathStart* start,
                   std::vector<CoatingResponse>& light) const {
    for (const LightSample& sample : samples) {
      CoatingResponse& sum = light[sample.group];
      DoubtfulLight doubtful;
      const std::uint32_t lanes = add_light(places, sample, sensor_.coating, *start++, sum, doubtful);
      if (lanes == 0) continue;
      const RayPacket shadow = shadow_rays(places.surface, doubtful, lanes);
      if (log_) log_->shadow.push_back(shadow);
      const std::uint32_t reached = lanes & ~scene_.blocked(shadow);
      for (int l = 0; l < kLanes; ++l) {
        if ((reached >> l & 1u) == 0) continue;
        sum.diffuse[l] += doubtful.response.diffuse[l];
        sum.gloss[l] += doubtful.response.gloss[l];
      }
    }
  }

  static RayPacket shadow_rays(const SurfacePack& surface, const DoubtfulLight& light, std::uint32_t valid) {
    RayPacket packet;
    for (int l = 0; l < kLanes; ++l)
      packet.set(l, lane_of(surface.shadow_origin, l), lane_of(light.direction, l), light.length[l]);
    packet.valid = valid;
    return packet;
  }

  double indirect_at(const SurfaceHit& hit, std::size_t group) const {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
      sum += hit.weights[k] * indirect_(membrane_.triangles(hit.triangle, k), static_cast<Eigen::Index>(group));
    return sum;
  }

  /// Adds all quantities except light; returns true if the point belongs to a printed marker.
  bool add_geometry(const SurfaceHit& hit, PixelSums& pixel) const {
    ++pixel.hits;
    pixel.depth += hit.point.z() - sensor_.camera.position_m.z();
    pixel.indentation += hit.indentation;
    pixel.normal -= hit.inner_normal;
    int nearest = 0;
    hit.weights.maxCoeff(&nearest);
    ContactState contact = ContactState::none;
    if (!fields_.contact.empty()) contact = fields_.contact[membrane_.triangles(hit.triangle, nearest)];
    bool on_marker = false;
    Vector3 rest = Vector3::Zero();
    for (int k = 0; k < 3; ++k) {
      const int vertex = membrane_.triangles(hit.triangle, k);
      rest += hit.weights[k] * membrane_.rest.row(vertex).transpose();
      if (fields_.traction_pa.rows() > 0)
        pixel.traction += hit.weights[k] * fields_.traction_pa.row(vertex).transpose();
    }
    if (sensor_.markers.radius_m) on_marker = sensor_.markers.covers(rest.x(), rest.y());
    pixel.on_marker += on_marker;
    ++pixel.contacts[static_cast<std::size_t>(contact)];
    const bool touched = contact != ContactState::none;
    const Segment segment = on_marker ? (touched ? Segment::marker_in_contact : Segment::marker)
                                      : (touched ? Segment::contact : Segment::gel);
    ++pixel.segments[static_cast<std::size_t>(segment)];
    return on_marker;
  }

  static void write_geometry(const PixelSums& pixel, int column, int row, TraceResult& out) {
    out.segment.at(column, row, 0) = most(pixel.segments);
    out.contact.at(column, row, 0) = pixel.hits > 0 ? most(pixel.contacts) : std::uint8_t{0};
    if (pixel.hits == 0) return;
    out.depth.at(column, row, 0) = static_cast<float>(pixel.depth / pixel.hits);
    out.indentation.at(column, row, 0) = static_cast<float>(pixel.indentation / pixel.hits);
    const Vector3 normal = pixel.normal.normalized();
    for (int c = 0; c < 3; ++c) {
      out.normal.at(column, row, c) = static_cast<float>(normal[c]);
      if (out.traction.channels == 3)
        out.traction.at(column, row, c) = static_cast<float>(pixel.traction[c] / pixel.hits);
    }
  }

  const RayScene& scene_;
  const Membrane& membrane_;
  const Sensor& sensor_;
  const SurfaceFields& fields_;
  Horizon horizon_;
  CameraModel camera_;
  std::vector<LightSource> sources_;
  std::optional<double> least_elevation_;  // squared tangent, for light of sources with points for full sight
  std::size_t sample_count_ = 0;
  int subpixels_;
  std::size_t groups_;
  RayLog* log_;
  VertexLight indirect_;  // no rows: not computed
};

}  // namespace

TraceResult trace(const RayScene& scene, const Membrane& membrane, const Sensor& sensor, const TraceSettings& settings,
                  const SurfaceFields& fields) {
  const int width = sensor.camera.width_px, height = sensor.camera.height_px;
  const int groups = static_cast<int>(light_groups(sensor.leds).size());
  const bool glossy = sensor.coating.specular_f0 > 0.0, printed = sensor.markers.radius_m.has_value();
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  TraceResult out{.basis = FloatImage(width, height, groups),
                  .gloss = FloatImage(width, height, glossy ? groups : 0),
                  .marked = FloatImage(width, height, printed ? groups : 0),
                  .marked_gloss = FloatImage(width, height, printed && glossy ? groups : 0),
                  .coverage = FloatImage(width, height, printed ? 1 : 0),
                  .indirect = FloatImage(width, height, settings.indirect_rays > 0 ? groups : 0),
                  .depth = FloatImage(width, height, 1, kNothing),
                  .normal = FloatImage(width, height, 3, kNothing),
                  .indentation = FloatImage(width, height, 1, kNothing),
                  .traction = FloatImage(width, height, fields.traction_pa.rows() > 0 ? 3 : 0, kNothing),
                  .contact = ByteImage(width, height, 1),
                  .segment = ByteImage(width, height, 1)};
  const RowTracer tracer(scene, membrane, sensor, settings, fields);
  std::vector<RowCounts> rows(height);
  const auto trace_row = [&](int row) { rows[row] = tracer.trace_row(row, out); };
  if (settings.log) {
    for (int row = 0; row < height; ++row) trace_row(row);
  } else {
    tbb::parallel_for(0, height, trace_row);
  }
  out.rays = std::int64_t{width} * height * settings.subpixels * settings.subpixels;
  for (const RowCounts& row : rows) {
    if (row.fallen_pixel) {
      throw DataError("a camera ray slips through the front face at pixel ({}, {}), even after a retry",
                      (*row.fallen_pixel)[0], (*row.fallen_pixel)[1]);
    }
    out.nudged_rays += row.rays.nudged;
    out.outside_rays += row.rays.outside;
  }
  return out;
}

}  // namespace tacipc
