#include "stages/image/render/render.h"

#include <cassert>
#include <limits>
#include <memory>
#include <utility>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/optics/membrane.h"
#include "common/sensor/camera_model.h"

namespace tacipc {
namespace {

double largest(const FloatImage& image) {
  double most = 0.0;
  for (const float value : image.pixels) {
    if (value > most) most = value;
  }
  return most;
}

void warn_of_dark_leds(const FloatImage& basis, const std::vector<LightGroup>& groups) {
  const auto count = static_cast<std::size_t>(basis.channels);
  std::vector<bool> lit(count, false);
  for (std::size_t i = 0; i < basis.pixels.size(); ++i) lit[i % count] = lit[i % count] || basis.pixels[i] > 0.0f;
  for (std::size_t g = 0; g < count; ++g) {
    if (lit[g]) continue;
    const std::string what =
        groups[g].name.empty() ? "LED " + std::to_string(groups[g].leds.front()) : "light group " + groups[g].name;
    log_warning("{} lights nothing the camera sees", what);
  }
}

/// Image points of markers: columns 0 and 1 hold the position, NaN if the picture does not show the marker; column 2 is
/// 1 or 0.
Positions project_markers(const Positions& markers, const Sensor& sensor, bool refract) {
  const CameraModel camera(sensor.camera, sensor.stack, refract);
  Positions out(markers.rows(), 3);
  for (Eigen::Index i = 0; i < markers.rows(); ++i) {
    const auto point = camera.project(markers.row(i).transpose());
    const bool seen = point && point->x() >= 0.0 && point->y() >= 0.0 && point->x() <= sensor.camera.width_px &&
                      point->y() <= sensor.camera.height_px;
    constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
    out.row(i) << (seen ? point->x() : kNothing), (seen ? point->y() : kNothing), seen ? 1.0 : 0.0;
  }
  return out;
}

}  // namespace

ByteImage read_reference(const std::filesystem::path& path, const Camera& camera) {
  ByteImage image = read_png(path, 3);
  if (image.width != camera.width_px || image.height != camera.height_px) {
    throw DataError("{}: the reference image has {} x {} pixels, the sensor's camera {} x {}", path.string(),
                    image.width, image.height, camera.width_px, camera.height_px);
  }
  return image;
}

RenderSummary render(const std::vector<RenderUnit>& units, const RenderConfig& config, const Deformation& front,
                     const std::function<void(const RenderedFrame&)>& deliver) {
  assert(!units.empty() && units.front().needs_rays);
  RenderSummary summary;
  const std::size_t last = front.num_frames() - 1;
  summary.frames = {0};
  if (config.frames == RenderedFrames::all) {
    for (std::size_t frame = 1; frame <= last; ++frame) summary.frames.push_back(frame);
  } else if (config.frames == RenderedFrames::phases) {
    const std::vector<std::size_t> ends = front.phase_ends();
    if (ends.empty() && last > 0)
      throw DataError("frames: phases: what is rendered has no phases (phase.npy of a press)");
    summary.frames.insert(summary.frames.end(), ends.begin(), ends.end());
  } else if (last > 0) {
    summary.frames.push_back(last);
  }
  std::vector<std::unique_ptr<Developer>> developers;
  for (const RenderUnit& unit : units) developers.push_back(make_developer(unit, config));
  Membrane membrane = front.at_rest();
  RayScene scene(membrane.positions, membrane.triangles);
  for (const std::size_t index : summary.frames) {
    if (index > 0) {
      front.move(membrane, index);
      scene.move(membrane.positions);
    }
    const SurfaceFields fields = front.fields(index, membrane);
    TraceResult first;
    for (std::size_t u = 0; u < units.size(); ++u) {
      const Sensor& sensor = units[u].sensor;
      TraceResult own;
      if (units[u].needs_rays) {
        TraceSettings settings = config.trace;
        if (sensor.leds.empty()) settings.indirect_rays = 0;
        own = trace(scene, membrane, sensor, settings, fields);
        summary.rays += own.rays;
        summary.nudged_rays += own.nudged_rays;
        summary.outside_rays += own.outside_rays;
        if (own.outside_rays == own.rays) throw DataError("the camera of {} sees nothing of the gel", sensor.name);
        if (index == 0) warn_of_dark_leds(own.basis, light_groups(sensor.leds));
        if (u == 0) first = std::move(own);
      }
      const TraceResult& traced = units[u].needs_rays && u > 0 ? own : first;
      Developer& developer = *developers[u];
      if (index == 0) developer.set_reference(traced);
      RenderedFrame frame{.index = index, .unit = units[u].name, .trace = units[u].needs_rays ? &traced : nullptr};
      if (config.linear) frame.linear = developer.radiance(traced);
      if (config.basis_images && units[u].needs_rays) {
        for (std::size_t g = 0; g < light_groups(sensor.leds).size(); ++g)
          frame.basis.push_back(group_image(traced, sensor, g));
      }
      frame.tactile = developer.develop(traced, false, index);
      if (config.marker && sensor.markers.radius_m) frame.marker = developer.develop(traced, true, index);
      if (units[u].needs_rays) frame.marker_px = project_markers(front.markers(index), sensor, config.trace.refract);
      if (u == 0) {
        summary.max_indentation_m = largest(traced.indentation);
        summary.indirect_share = indirect_share(traced, sensor);
        log_info("frame {}: deepest indentation {:.3f} mm, {:.2f} % clipped", index, 1e3 * summary.max_indentation_m,
                 100.0 * frame.tactile.clipped_fraction);
      }
      deliver(frame);
    }
  }
  for (const auto& developer : developers) summary.units.push_back(developer->summary());
  return summary;
}

}  // namespace tacipc
