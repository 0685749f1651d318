// Measures the cost of rendering: frames on one and two threads, tracing compared with Embree's own rate, scene
// updates.
#include <fmt/core.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "bench/embree_rate.h"
#include "bench/machine.h"
#include "bench_render_texts.h"
#include "common/base/error.h"
#include "common/base/files.h"
#include "common/stage/stage.h"
#include "stages/image/render/pressed_gel.h"
#include "stages/image/render/render.h"

using namespace tacipc;

namespace {

const StageSpec kBench{
    .name = "bench_render",
    .summary = "Measure what rendering a frame costs.",
    .inputs = {{"--sensor", "the sensor (YAML)"}, {"--gel", "gel.msh of tetmesh"}, {"--press", "folder of a press"}}};

using bench::processor_s;
using bench::wall_s;

/// Measured cost of one render configuration.
struct RenderCost {
  std::string name;
  std::size_t lights = 0;
  int subpixels = 1;
  int led_samples = 1;
  double processor_ms = 0.0;  // processor time of a frame on one thread, independent of the machine's load
  double one_thread_ms =
      0.0;  // wall time of a frame: rays, light, colours, grey levels; without files and scene update
  double two_threads_ms = 0.0;
  double must_ms = 0.0;      // limit on two threads
  double camera_rays = 0.0;  // number of camera rays of the logged picture
  double shadow_rays = 0.0;
  double traced_s = 0.0;        // time of RayScene for those rays, one thread
  double embree_s = 0.0;        // Embree's own time for them
  double logged_frame_s = 0.0;  // time of the picture from which the rays were logged, one thread

  double tracing_share() const { return traced_s / logged_frame_s; }
  double of_embree() const { return embree_s / traced_s; }
};

struct SceneUpdate {
  std::size_t triangles = 0;
  double membrane_ms = 0.0;  // update of vertices and normals for the next frame
  double tree_ms = 0.0;      // update of Embree's tree
};

/// Page of the results. `load` is the number of runnable processes in the last minute on `cores` cores; wall times are
/// less reliable the more there are.
std::string render_page(const std::vector<RenderCost>& costs, const SceneUpdate& update, const std::string& processor,
                        double load, unsigned cores) {
  std::string frames, tracing;
  for (const RenderCost& cost : costs) {
    frames += fmt::format("| {} | {} | {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} |\n", cost.name,
                          cost.subpixels * cost.subpixels,
                          cost.lights * static_cast<std::size_t>(cost.led_samples * cost.led_samples),
                          cost.processor_ms, cost.one_thread_ms, cost.two_threads_ms, cost.must_ms);
    const double rays = cost.camera_rays + cost.shadow_rays;
    tracing += fmt::format("| {} | {:.0f} | {:.0f} | {:.1f} | {:.1f} | {:.0f} % (at least 60) | {:.0f} % |\n",
                           cost.name, cost.camera_rays, cost.shadow_rays, 1e-6 * rays / cost.traced_s,
                           1e-6 * rays / cost.embree_s, 100.0 * cost.of_embree(), 100.0 * cost.tracing_share());
  }
  return fmt::format(kRenderingPage, processor, load, cores, frames, tracing, update.triangles, update.membrane_ms,
                     update.tree_ms, update.membrane_ms + update.tree_ms);
}

/// Least time of several runs, s, by a clock.
template <typename Work>
double least_s(int repeats, const Work& work, double (*clock_s)() = wall_s) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i) {
    const double start = clock_s();
    work();
    least = std::min(least, clock_s() - start);
  }
  return least;
}

/// Sensor with eight equal light sources on the ring of its first LED, each a group.
Sensor with_eight(Sensor sensor, double size_m) {
  const Led first = sensor.leds.front();
  const double radius = first.position_m.head<2>().norm();
  sensor.leds.clear();
  for (int k = 0; k < 8; ++k) {
    const double azimuth = k * std::numbers::pi / 4.0;
    Led led = first;
    led.position_m = {radius * std::cos(azimuth), radius * std::sin(azimuth), first.position_m.z()};
    led.rgb = {1.0, 1.0, 1.0};
    led.group.clear();
    led.intensity = 1.0;
    led.size_m = {size_m, size_m};
    sensor.leds.push_back(led);
  }
  sensor.camera.width_px = 640;
  sensor.camera.height_px = 480;
  sensor.reference_image.reset();
  return sensor;
}

/// Renders one frame, from rays to grey levels.
void render_frame(const RayScene& scene, const Membrane& membrane, const Sensor& sensor, const TraceSettings& settings,
                  const SurfaceFields& fields, double exposure) {
  const TraceResult traced = trace(scene, membrane, sensor, settings, fields);
  const FloatImage signal = camera_signal(color_image(traced, sensor, false), sensor.camera, sensor.response);
  const TactileImage image = quantise(encode(signal, exposure, sensor.response));
  if (image.image.pixels.empty()) throw DataError("nothing was rendered");
}

double count(const std::vector<RayPacket>& packets) {
  double rays = 0.0;
  for (const RayPacket& packet : packets) rays += std::popcount(packet.valid);
  return rays;
}

RenderCost measure(const std::string& name, const RayScene& scene, const Membrane& membrane, const Sensor& sensor,
                   TraceSettings settings, const SurfaceFields& fields, int repeats, double must_ms, int log_scale) {
  RenderCost cost{.name = name,
                  .lights = sensor.leds.size(),
                  .subpixels = settings.subpixels,
                  .led_samples = sensor.leds.front().size_m[0] > 0.0 ? settings.led_samples : 1,
                  .must_ms = must_ms};
  // The exposure belongs to the sensor and is computed once, from its reference.
  const FloatImage once = color_image(trace(scene, membrane, sensor, settings, fields), sensor, false);
  const double exposure = solve_exposure(camera_signal(once, sensor.camera, sensor.response), sensor.response);
  const auto frame_ms = [&](std::size_t threads, double (*clock_s)()) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return 1e3 * least_s(
                     repeats, [&] { render_frame(scene, membrane, sensor, settings, fields, exposure); }, clock_s);
  };
  cost.processor_ms = frame_ms(1, processor_s);
  cost.one_thread_ms = frame_ms(1, wall_s);
  cost.two_threads_ms = frame_ms(2, wall_s);

  Sensor smaller = sensor;
  smaller.camera.width_px /= log_scale;
  smaller.camera.height_px /= log_scale;
  RayLog log;
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    cost.logged_frame_s = least_s(repeats, [&] { render_frame(scene, membrane, smaller, settings, fields, exposure); });
    settings.log = &log;
    trace(scene, membrane, smaller, settings, fields);
  }
  cost.camera_rays = count(log.camera);
  cost.shadow_rays = count(log.shadow);
  const FlushDenormals flush;
  std::int64_t seen = 0;
  cost.traced_s = least_s(repeats, [&] {
    for (const RayPacket& packet : log.camera) seen += scene.first_hits(packet)[0];
    for (const RayPacket& packet : log.shadow) seen += scene.blocked(packet);
  });
  if (seen == 0) throw DataError("no ray met anything");
  const auto embree = bench::embree_seconds(membrane.positions, membrane.triangles, log.camera, log.shadow, repeats);
  cost.embree_s = embree.camera + embree.shadow;
  return cost;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kBench, argc, argv, [](Stage& stage) {
    const double load = bench::load_average();
    const auto sensor = stage.read_config<Sensor>("--sensor");
    const TetMesh gel = read_tet_mesh(stage.input("--gel"));
    const PressedGel press(stage.input("--press"), gel);
    const std::size_t last = press.num_frames() - 1;
    Membrane membrane = make_membrane(gel, gel.positions);
    RayScene scene(membrane.positions, membrane.triangles);
    const Positions pressed = press.positions(last);
    const SceneUpdate update{.triangles = static_cast<std::size_t>(membrane.triangles.rows()),
                             .membrane_ms = 1e3 * least_s(20, [&] { move_membrane(membrane, pressed); }),
                             .tree_ms = 1e3 * least_s(20, [&] { scene.move(membrane.positions); })};
    const SurfaceFields fields = press.fields(last, membrane);
    const std::vector<RenderCost> costs = {
        measure("point lights", scene, membrane, with_eight(sensor, 0.0), {.subpixels = 1}, fields, 7, 200.0, 1),
        measure("area lights", scene, membrane, with_eight(sensor, 5e-3), {.subpixels = 2, .led_samples = 3}, fields, 3,
                3000.0, 4)};
    write_file(stage.output("render_performance.md"),
               render_page(costs, update, bench::processor(), load, std::thread::hardware_concurrency()));
    stage.summarize({{"point_lights_2_threads_ms", costs[0].two_threads_ms},
                     {"area_lights_2_threads_ms", costs[1].two_threads_ms},
                     {"of_embree", std::min(costs[0].of_embree(), costs[1].of_embree())},
                     {"scene_update_ms", update.membrane_ms + update.tree_ms}});
  });
}
