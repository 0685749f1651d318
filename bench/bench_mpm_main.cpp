// Measures the cost of material points: steps under a press on one and two threads, compared with the memory bandwidth.
#include <fmt/core.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "bench/machine.h"
#include "bench_mpm_texts.h"
#include "common/base/error.h"
#include "common/base/files.h"
#include "common/sample/placement.h"
#include "common/stage/stage.h"
#include "stages/rival/mpm/run_motion.h"

using namespace tacipc;

namespace {

const StageSpec kBench{.name = "bench_mpm",
                       .summary = "Measure what material points cost.",
                       .inputs = {InputSpec::several("--config", "numerics of mpm (YAML)"),
                                  {"--sensor", "the sensor (YAML)"},
                                  {"--object", "triangle mesh in metres (object.ply of decimate)"}}};

using bench::processor_s;
using bench::wall_s;

/// One configuration of the gel, measured while an object presses into it.
struct MpmCost {
  std::string name;
  std::size_t particles = 0;
  std::size_t nodes = 0;
  double step_s = 0.0;           // time step of the simulation
  double press_steps = 0.0;      // steps for 1 mm at the configured speed
  double bytes = 0.0;            // memory traffic per particle and step
  double processor_rate = 0.0;   // particles · steps per second of processor time, one thread
  double one_thread_rate = 0.0;  // particles · steps per second of wall time, one thread
  double two_threads_rate = 0.0;
};

/// Memory bandwidth, bytes per second of processor time for a = b + s c on one thread, over arrays far larger than any
/// cache. It is the yardstick for work that only streams through memory. Written bytes count twice, because they are
/// first fetched. Best of `repeats`.
double memory_bytes_per_s(int repeats) {
  constexpr std::size_t kFloats = std::size_t{1} << 25;  // 128 MiB per array
  std::vector<float> a(kFloats, 0.0f), b(kFloats, 1.0f), c(kFloats, 2.0f);
  double least_s = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const auto factor = static_cast<float>(repeat);
    const double start = processor_s();
    for (std::size_t i = 0; i < kFloats; ++i) a[i] = b[i] + factor * c[i];
    least_s = std::min(least_s, processor_s() - start);
    if (a[kFloats / 3] != 1.0f + 2.0f * factor) throw DataError("memory holds something else than was written");
  }
  return 4.0 * sizeof(float) * static_cast<double>(kFloats) / least_s;
}

/// `load` is the number of runnable processes of the last minute on `cores` cores.
std::string mpm_page(const std::vector<MpmCost>& costs, double memory_bytes_per_s, const std::string& processor,
                     double load, unsigned cores) {
  std::string out = fmt::format(kMaterialPointsPage, processor, load, cores, 1e-9 * memory_bytes_per_s);
  for (const MpmCost& cost : costs) {
    const double limit = memory_bytes_per_s / cost.bytes;
    out += fmt::format(
        "| {} | {} | {} | {:.0f} | {:.1f} | {:.1f} | {:.0f} % | {:.1f} | {:.1f} | {:.0f} steps of {:.3g} µs, {:.0f} s "
        "CPU |\n",
        cost.name, cost.particles, cost.nodes, cost.bytes, 1e-6 * limit, 1e-6 * cost.processor_rate,
        100.0 * cost.processor_rate / limit, 1e-6 * cost.one_thread_rate, 1e-6 * cost.two_threads_rate,
        cost.press_steps, 1e6 * cost.step_s,
        static_cast<double>(cost.particles) * cost.press_steps / cost.processor_rate);
  }
  return out;
}

/// Bytes of one node in one step: zeroed, added to and updated (fetched and written back each), and read.
constexpr double kBytesPerNodeStep = 16.0 * (2 + 2 + 2 + 1);

/// Object that starts one cell above the gel and moves down with every step.
class Press {
 public:
  explicit Press(const MpmScene& scene)
      : scene_(scene),
        points_(scene.lattice.rest_m, scene.setup),
        pose_(place(scene.object.positions, {.face = scene.face}, scene.setup.grid_spacing_m)) {
    points_.place_object(scene.object_points_m, pose_);
  }
  void steps(int count) {
    for (int s = 0; s < count; ++s) {
      pose_(2, 3) -= scene_.config.object.press_speed_m_s * scene_.setup.step_s;
      points_.step(pose_);
    }
  }
  std::size_t nodes() const { return points_.num_nodes(); }

 private:
  const MpmScene& scene_;
  MaterialPoints points_;
  Matrix4 pose_;
};

MpmCost measure(const std::filesystem::path& file, const Sensor& sensor, const TriangleMesh& object) {
  constexpr int kRepeats = 5;
  const auto config = read_config<MpmConfig>(file);
  const MpmScene scene = make_scene(config, sensor, {}, object, "+z");
  // Number of steps that takes about a tenth of a second per measurement on current processors.
  const int count = std::max(4, static_cast<int>(5e6 / static_cast<double>(scene.lattice.rest_m.rows())));
  MpmCost cost{.name = fmt::format("`{}`", file.stem().string()),
               .particles = static_cast<std::size_t>(scene.lattice.rest_m.rows()),
               .step_s = scene.setup.step_s,
               .press_steps = 1e-3 / (config.object.press_speed_m_s * scene.setup.step_s)};
  const double work = static_cast<double>(cost.particles) * count;
  for (const std::size_t threads : {std::size_t{1}, std::size_t{2}}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    double& rate = threads == 1 ? cost.one_thread_rate : cost.two_threads_rate;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
      Press press(scene);
      press.steps(2);
      const double wall = wall_s(), processor = processor_s();
      press.steps(count);
      rate = std::max(rate, work / (wall_s() - wall));
      if (threads == 1) cost.processor_rate = std::max(cost.processor_rate, work / (processor_s() - processor));
      cost.nodes = press.nodes();
    }
  }
  cost.bytes =
      kBytesPerParticleStep + kBytesPerNodeStep * static_cast<double>(cost.nodes) / static_cast<double>(cost.particles);
  return cost;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kBench, argc, argv, [](Stage& stage) {
    const double load = bench::load_average();
    const auto sensor = stage.read_config<Sensor>("--sensor");
    const TriangleMesh object = read_triangle_mesh(stage.input("--object"), 1.0);
    std::vector<MpmCost> costs;
    for (const auto& file : stage.inputs("--config")) costs.push_back(measure(file, sensor, object));
    const double memory = memory_bytes_per_s(5);
    write_file(stage.output("mpm_performance.md"),
               mpm_page(costs, memory, bench::processor(), load, std::thread::hardware_concurrency()));
    Value::Map rates;
    for (const MpmCost& cost : costs) rates.emplace_back(cost.name, cost.processor_rate);
    stage.summarize({{"particle_steps_per_processor_s", rates}, {"memory_bytes_per_s", memory}});
  });
}
