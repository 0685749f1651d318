#include <chrono>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/sample/sample_inputs.h"
#include "common/stage/stage.h"
#include "stages/rival/mpm/outputs.h"

namespace {

using namespace tacipc;

const StageSpec kMpm{
    .name = "mpm",
    .summary = "Press an object into a gel of material points, as Tacchi does: MLS-MPM in three dimensions.",
    .inputs = {{"--config", "numerics (YAML)"},
               {"--sensor", "sensor (YAML)"},
               {"--sample", "placement and motion (YAML)"},
               {"--object", "triangle mesh in metres (object.ply of decimate)"},
               InputSpec::optional("--object-config", "the object's YAML: which side is up")},
    .options = {{.flag = "--name", .help = "the sample's name", .fallback = "sample"}}};

double wall_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Runs a motion with progress messages. `of` is the fraction of the whole work in this run, `before` the fraction
/// already done.
MpmRun run_with_progress(const MpmScene& scene, double speed_factor, double before, double of) {
  return run_motion(scene, speed_factor, [&](int frame, int count, int steps, double depth_m) {
    show_progress(before + of * (frame - 1.0) / count,
                  depth_m > 0.0
                      ? fmt::format("frame {}/{}, step {}, gel {:.3f} mm deep", frame, count, steps, 1e3 * depth_m)
                      : fmt::format("frame {}/{}, step {}", frame, count, steps));
  });
}

/// Repeats the motion at half speed and reports the change.
/// \throw VerdictError if it is too large
SpeedEffect try_half_speed(const Sensor& sensor, const MpmScene& scene, const std::vector<Positions>& markers) {
  log_info("again at half speed");
  const MpmRun slower = run_with_progress(scene, 0.5, 1.0 / 3.0, 2.0 / 3.0);
  const SpeedEffect effect = speed_effect(markers, markers_of_frames(sensor, scene, slower));
  const double limit = *scene.config.largest_change;
  const std::string text = fmt::format(
      "half the speed changes the markers by {:.2f} % (limit {:.2f} %), by {:.2f} % in the last frame and at most by "
      "{:.2f} % (frame {})",
      100.0 * effect.change, 100.0 * limit, 100.0 * effect.last_frame, 100.0 * effect.worst_frame, effect.worst);
  if (!(effect.change < limit))
    throw VerdictError({static_cast<int>(effect.worst), "marker_change_at_half_speed", effect.change, limit}, text);
  log_info("{}", text);
  return effect;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kMpm, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<MpmConfig>("--config");
    const auto sensor = stage.read_config<Sensor>("--sensor");
    const SampleInputs inputs = read_sample(stage);
    const MpmScene scene = make_scene(config, sensor, inputs.sample, inputs.object, inputs.face);
    log_info("{} particles, steps of {:.3g} s, {} points of the object, {:.3g} per mm2", scene.lattice.rest_m.rows(),
             scene.setup.step_s, scene.object_points_m.rows(), 1e-6 * scene.points_per_m2());
    if (!sensor.material.relaxation.empty())
      log_warning("{}: material points do not relax, they have the long-term modulus", sensor.name);
    if (sensor.mount.gives_way()) log_warning("{}: the mount of material points is rigid", sensor.name);
    const double start_s = wall_s();
    const MpmRun run = run_with_progress(scene, 1.0, 0.0, config.largest_change ? 1.0 / 3.0 : 1.0);
    const double took_s = wall_s() - start_s;
    const std::vector<Positions> markers = markers_of_frames(sensor, scene, run);
    std::optional<SpeedEffect> effect;
    if (config.largest_change) effect = try_half_speed(sensor, scene, markers);
    write_outputs(stage, sensor, scene, run, markers, effect);
    const double particle_steps = static_cast<double>(scene.lattice.rest_m.rows()) * run.frames.back().steps;
    stage.cost({{"motion_s", took_s}, {"particle_steps_per_s", particle_steps / took_s}});
  });
}
