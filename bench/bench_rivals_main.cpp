// Measures the cost of a tactile image: for TacIPC from a press, and for simulators that use only the object's depth.
#include <fmt/core.h>
#include <tbb/global_control.h>

#include <array>
#include <map>
#include <optional>
#include <utility>

#include "bench/machine.h"
#include "bench/rivals_report.h"
#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/statistics.h"
#include "common/optics/seen_membrane.h"
#include "common/sample/front_frames.h"
#include "common/sensor/light_field.h"
#include "common/stage/stage.h"
#include "common/stage/stage_timings.h"
#include "stages/rival/baseline/kernel.h"
#include "stages/rival/baseline/simulator.h"

using namespace tacipc;

namespace {

const StageSpec kBench{
    .name = "bench_rivals",
    .summary = "Measure what a tactile image costs, by ours and other simulators.",
    .inputs = {
        {"--sensor", "the sensor (YAML); its images get the sizes that are measured"},
        InputSpec::several("--press", "folders of presses, whose cost counts; the first one's frames are pictured"),
        {"--gel", "gel.msh of these presses"},
        {"--object", "object of the first press (object.ply)"},
        {"--light", "light.yaml of calibrate, for TacIPC's images"},
        InputSpec::several_named("--configs", "baseline configurations, by method"),
        InputSpec::any_number_named("--lights", "light of a method whose configuration has none of its own"),
        InputSpec::any_number_named("--mpm", "folders of mpm, by method: seen under TacIPC's light")}};

constexpr std::array<std::array<int, 2>, 2> kSizes{{{320, 240}, {640, 480}}};
constexpr int kLeastFrames = 12;  // least number of timed frames per method; fewer frames are repeated

/// Sensor with the same field of view along x, and images of another size.
Sensor resized(Sensor sensor, int width_px, int height_px) {
  Camera& camera = sensor.camera;
  if (camera.intrinsics_px) throw DataError("the sensor's camera has intrinsics, which belong to one size of image");
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.window_height_m = camera.window_width_m * height_px / width_px;
  return sensor;
}

template <typename Work>
double timed_ms(Work&& work) {
  const double started = bench::processor_s();
  work();
  return 1e3 * (bench::processor_s() - started);
}

ImageSpeed sized(const std::string& method, const Sensor& sensor) {
  return {.method = method, .width_px = sensor.camera.width_px, .height_px = sensor.camera.height_px};
}

/// Frames 1 … count of a press or a list of poses, repeated as needed.
/// \pre count > 0
std::vector<std::size_t> timed_frames(std::size_t count) {
  std::vector<std::size_t> frames;
  while (frames.size() < kLeastFrames)
    for (std::size_t frame = 1; frame <= count; ++frame) frames.push_back(frame);
  return frames;
}

/// Medians over frames. `view(frame)` gives a visible membrane, which is then lit and added to a photograph.
template <typename View>
ImageSpeed of_views(const std::string& method, std::size_t frames, const LightField& light, const Sensor& sensor,
                    View&& view) {
  const ByteImage background(sensor.camera.width_px, sensor.camera.height_px, 3, 128);
  std::vector<double> membrane, lit;
  for (const std::size_t frame : timed_frames(frames)) {
    MembraneView seen;
    membrane.push_back(timed_ms([&] { seen = view(frame); }));
    lit.push_back(timed_ms([&] { add_change(background, code_change(light, seen)); }));
  }
  ImageSpeed speed = sized(method, sensor);
  speed.membrane_ms = upper_median(membrane);
  speed.light_ms = upper_median(lit);
  return speed;
}

/// Simulations of several folders: total processor time over the total number of frames.
struct Simulation {
  double processor_s = 0.0;
  std::size_t frames = 0;

  void add(const std::filesystem::path& record, std::size_t count) {
    processor_s += read_timings_of(record).processor_s;
    frames += count;
  }
  double ms() const { return 1e3 * processor_s / static_cast<double>(frames); }
};

ImageSpeed of_baseline(const std::string& method, const BaselineSimulator& simulator,
                       const std::vector<Matrix4>& poses) {
  std::vector<double> object, membrane, lit;
  for (const std::size_t frame : timed_frames(poses.size() - 1)) {
    SeenObject seen;
    object.push_back(timed_ms([&] { seen = simulator.seen(poses[frame]); }));
    const BaselineFrame made = simulator.frame(std::move(seen));
    membrane.push_back(1e3 * made.membrane_s);
    lit.push_back(1e3 * made.light_s);
  }
  ImageSpeed speed = sized(method, simulator.sensor());
  speed.object_ms = upper_median(object);
  speed.membrane_ms = upper_median(membrane);
  speed.light_ms = upper_median(lit);
  return speed;
}

/// Map in another size by the nearest pixel's value, to time the following steps.
FloatImage nearest(const FloatImage& map, int width_px, int height_px) {
  FloatImage out(width_px, height_px, 1);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x)
      out.at(x, y, 0) = map.at(x * map.width / width_px, y * map.height / height_px, 0);
  return out;
}

/// Maps of every frame with contact in a folder written by mpm.
std::vector<FloatImage> read_maps(const std::filesystem::path& folder) {
  std::vector<FloatImage> maps;
  for (std::size_t frame = 1;; ++frame) {
    const auto file = folder / fmt::format("frame_{:04}", frame) / "seen_indentation.exr";
    if (!std::filesystem::exists(file)) break;
    maps.push_back(read_exr(file, {"Y"}));
  }
  if (maps.empty()) throw DataError("{}: has no frame_0001/seen_indentation.exr", folder.string());
  return maps;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kBench, argc, argv, [](Stage& stage) {
    const double load = bench::load_average();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    keep_to_one_thread();
    const auto sensor = stage.read_config<Sensor>("--sensor");
    const auto light = stage.read_config<LightField>("--light");
    std::optional<FrontFrames> first;
    Simulation pressed;
    for (const auto& folder : stage.inputs("--press")) {
      FrontFrames frames = read_front_frames(folder, stage.input("--gel"));
      if (frames.frames.size() < 2) throw DataError("{}: has no frame after the first", folder.string());
      pressed.add(folder / "press.yaml", frames.frames.size() - 1);
      if (!first) first = std::move(frames);
    }
    const FrontFrames& press = first.value();
    std::map<std::string, BaselineConfig> configs;
    for (const auto& [method, file] : stage.named_inputs("--configs"))
      configs[method] = read_config<BaselineConfig>(file);
    std::map<std::string, std::filesystem::path> lights;
    for (const auto& [method, file] : stage.named_inputs("--lights")) {
      if (!configs.contains(method)) throw UsageError(fmt::format("--lights {}: has no configuration", method));
      lights[method] = file;
    }
    for (const auto& [method, config] : configs)
      if (!config.change || config.change->needs_light() != lights.contains(method))
        throw UsageError(fmt::format("--configs {}: needs a shading, and a light if the shading has none", method));
    std::map<std::string, std::pair<Simulation, std::vector<FloatImage>>> particles;
    for (const auto& [method, folder] : stage.named_inputs("--mpm")) {
      const auto maps = read_maps(folder);
      auto& [simulation, all] = particles[method];
      simulation.add(folder / "mpm.yaml", maps.size());
      all.insert(all.end(), maps.begin(), maps.end());
    }

    std::vector<ImageSpeed> speeds;
    for (const auto [width, height] : kSizes) {
      const Sensor camera = resized(sensor, width, height);
      speeds.push_back(of_views("ours", press.frames.size() - 1, light, camera, [&](std::size_t frame) {
        return view_membrane(press.frames[frame], press.triangles, camera);
      }));
      speeds.back().simulation_ms = pressed.ms();
      for (const auto& [method, config] : configs) {
        const auto own = lights.find(method);
        BaselineSimulator simulator(
            config, camera, ByteImage(width, height, 3, 128),
            own == lights.end() ? std::nullopt : std::optional<std::filesystem::path>(own->second));
        simulator.take_object(stage.input("--object"));
        speeds.push_back(of_baseline(method, simulator, press.gel_from_object));
      }
      for (const auto& [method, simulated] : particles) {
        std::vector<FloatImage> maps;  // maps in this size, made before the clock starts
        for (const FloatImage& map : simulated.second) maps.push_back(nearest(map, width, height));
        speeds.push_back(of_views(method, maps.size(), light, camera,
                                  [&](std::size_t frame) { return view_height_map(maps[frame - 1], camera); }));
        speeds.back().simulation_ms = simulated.first.ms();
      }
    }
    write_file(stage.varying_output("image_speeds.csv"), to_csv(speeds));
    write_file(stage.varying_output("speeds.md"),
               bench::rivals_table(speeds, pressed.frames, bench::processor(), load));
    stage.summarize({{"methods", speeds.size() / kSizes.size()}});
  });
}
