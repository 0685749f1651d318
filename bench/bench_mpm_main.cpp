// Measures what material points cost: steps under a press on one and two threads, beside the rate of memory.
#include <fmt/core.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <thread>

#include "bench/machine.h"
#include "bench/memory_rate.h"
#include "bench/mpm_report.h"
#include "common/base/error.h"
#include "common/base/files.h"
#include "common/sample/placement.h"
#include "common/stage/stage.h"
#include "stages/rival/mpm/run_motion.h"

using namespace tacipc;

namespace {

const StageSpec kBench{.name = "bench_mpm",
                       .summary = "Measure what material points cost.",
                       .inputs = {{.flag = "--config", .help = "numerics of mpm (YAML)", .many = true},
                                  {.flag = "--sensor", .help = "the sensor (YAML)"},
                                  {.flag = "--object", .help = "triangle mesh in metres (object.ply of decimate)"}}};

using bench::processor_s;
using bench::wall_s;

/// Bytes of one node in one step: zeroed, added to and updated (fetched and written back each), read.
constexpr double kBytesPerNodeStep = 16.0 * (2 + 2 + 2 + 1);

/// An object that stands a cell above the gel and goes down with every step.
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

bench::MpmCost measure(const std::filesystem::path& file, const Sensor& sensor, const TriangleMesh& object) {
  constexpr int kRepeats = 5;
  const auto config = read_config<MpmConfig>(file);
  const MpmScene scene = make_scene(config, sensor, {}, object, "+z");
  // About a tenth of a second each, at rates of this decade.
  const int count = std::max(4, static_cast<int>(5e6 / static_cast<double>(scene.lattice.rest_m.rows())));
  bench::MpmCost cost{.name = fmt::format("`{}`", file.stem().string()),
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
    std::vector<bench::MpmCost> costs;
    for (const auto& file : stage.inputs("--config")) costs.push_back(measure(file, sensor, object));
    const double memory = bench::memory_bytes_per_s(5);
    write_file(stage.output("mpm_performance.md"),
               bench::mpm_page(costs, memory, bench::processor(), load, std::thread::hardware_concurrency()));
    Value::Map rates;
    for (const bench::MpmCost& cost : costs) rates.emplace_back(cost.name, cost.processor_rate);
    stage.summarize({{"particle_steps_per_processor_s", rates}, {"memory_bytes_per_s", memory}});
  });
}
