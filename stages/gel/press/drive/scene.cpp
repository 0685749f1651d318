#include "stages/gel/press/drive/scene.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/base/log.h"
#include "stages/gel/press/contact/surface_pairs.h"
#include "stages/gel/press/drive/checkpoint.h"
#include "stages/gel/press/solve/step_limit.h"
#include "stages/gel/press/world/world.h"

namespace tacipc {
namespace {

constexpr double kApart_m = 1e-4;  // a restored frame belongs to another motion if a body is farther from its path

class SceneDrive {
 public:
  SceneDrive(const Sensor& sensor, const std::vector<SceneBody>& bodies, const PressConfig& config,
             const SceneSpec& spec, const ProgressObserver& observe, FrameStore* store)
      : files_(bodies),
        config_(config),
        spec_(spec),
        world_(sensor, config, scene_bodies(sensor, bodies, config, spec),
               {.gravity_m_s2 = spec.gravity_m_s2, .pairs = scene_contact(sensor, config, spec)}),
        run_(num_frames(spec.motion), observe, store),
        loads_n_(world_.num_free(), Vector3::Zero()) {
    for (std::size_t g = 0; g < world_.num_gels(); ++g) out_.gels.push_back(world_.simulation_of(g));
    for (std::size_t i = 0; i < world_.num_free(); ++i) out_.mass_kg.push_back(world_.affine(i).mass_kg);
    if (config.friction) out_.slip_speed_m_s = friction_settings(*config.friction, world_.scales()).speed_threshold_m_s;
    for (const ContactSpec& pair : spec.contact)
      out_.contact.push_back(world_.laws().of(pair.between[0], pair.between[1]));
  }

  Scene run() {
    if (!restored()) {
      world_.require_apart();
      finish(-1, {});
    }
    for (std::size_t p = 0; p < spec_.motion.size(); ++p) run_phase(spec_.motion[p], static_cast<int>(p));
    for (std::size_t g = 0; g < out_.gels.size(); ++g) {
      const std::vector<Frame>& frames = out_.gels[g].frames;
      if (std::none_of(frames.begin(), frames.end(), touches))
        log_warning("nothing touched {} in any frame", spec_.bodies[g].name);
    }
    out_.times = world_.stepper().times();
    for (Simulation& gel : out_.gels) gel.times = out_.times;
    return std::move(out_);
  }

 private:
  /// Poses of all bodies at a fraction of a phase: prescribed poses of bodies that the scene moves, present poses of
  /// the others.
  std::vector<Matrix4> poses_in(const ScenePhase& phase, const std::vector<Matrix4>& start, double fraction) const {
    std::vector<Matrix4> poses = world_.state().world_from_body;
    for (std::size_t b = 0; b < files_.size(); ++b) {
      if (!files_[b].path.empty())
        poses[b] = pose_on_path(files_[b].path, steps_before_ + fraction * phase.steps * phase.substeps);
    }
    for (const WaySpec& move : phase.move) {
      const auto body = static_cast<std::size_t>(move.body);
      poses[body] = moved(start[body], move.way * (move.smooth ? smooth_part(fraction) : fraction));
    }
    return poses;
  }

  bool is_held_in(const ScenePhase& phase, std::size_t body) const {
    const int b = static_cast<int>(body);
    return !files_[body].path.empty() ||
           std::any_of(phase.move.begin(), phase.move.end(), [&](const WaySpec& move) { return move.body == b; }) ||
           std::find(phase.hold.begin(), phase.hold.end(), b) != phase.hold.end();
  }

  Vector3 load_in(const ScenePhase& phase, std::size_t i, double fraction) const {
    for (const auto& [body, load_n] : phase.load_n) {
      if (body == static_cast<int>(world_.object(i))) return loads_n_[i] + fraction * (load_n - loads_n_[i]);
    }
    return loads_n_[i];
  }

  /// Takes one time step between two fractions of a phase; divides it if it does not converge.
  void step(const ScenePhase& phase, const std::vector<Matrix4>& start, double from, double to, int halvings,
            StepReport& report) {
    const std::vector<Matrix4> poses = poses_in(phase, start, to);
    StepGoal goal = world_.goal((to - from) * phase.steps * phase.substeps * config_.time_step_s);
    world_.move_mounts(goal, poses);
    for (std::size_t i = 0; i < world_.num_free(); ++i) {
      goal.body_load_n.push_back(load_in(phase, i, to));
      if (is_held_in(phase, world_.object(i))) world_.hold(goal, i, poses[world_.object(i)]);
    }
    require_free_way(goal);
    run_.advance_or_divide(
        halvings, config_.max_halvings, report, [&] { return world_.advance(goal, poses, run_.observer()); },
        [&](int deeper) {
          const double middle = 0.5 * (from + to);
          step(phase, start, from, middle, deeper, report);
          step(phase, start, middle, to, deeper, report);
        });
  }

  void run_phase(const ScenePhase& phase, int index) {
    WorldState& state = world_.state();
    const std::vector<Matrix4> start = state.world_from_body;
    const double start_s = state.time_s;
    const int steps = phase.steps * phase.substeps;
    for (int f = 1; f <= phase.steps; ++f) {
      if (restored()) continue;
      const StepReport report = run_.solve([&](StepReport& sum) {
        for (int i = (f - 1) * phase.substeps; i < f * phase.substeps; ++i)
          step(phase, start, static_cast<double>(i) / steps, (i + 1.0) / steps, 0, sum);
      });
      state.time_s = start_s + f * phase.substeps * config_.time_step_s;
      finish(index, report);
    }
    steps_before_ += steps;
    for (std::size_t i = 0; i < loads_n_.size(); ++i) loads_n_[i] = load_in(phase, i, 1.0);
  }

  bool restored() {
    const std::optional<std::string> bytes = run_.restored();
    if (!bytes) return false;
    SceneFrame frame;
    std::vector<Frame> of_gels;
    unpack_frame(*bytes, frame, of_gels, world_.state());
    require_gels(of_gels.size(), world_.num_gels());
    for (std::size_t g = 0; g < of_gels.size(); ++g) out_.gels[g].frames.push_back(std::move(of_gels[g]));
    require_on_path();
    out_.frames.push_back(std::move(frame));
    return true;
  }

  /// Checks the restored frame, the one after out_.frames. \throw DataError if it was solved with other paths
  void require_on_path() const {
    int at = 0;
    for (std::size_t p = 0, left = out_.frames.size(); p < spec_.motion.size() && left > 0; ++p) {
      const auto frames = std::min(left, static_cast<std::size_t>(spec_.motion[p].steps));
      at += static_cast<int>(frames) * spec_.motion[p].substeps;
      left -= frames;
    }
    for (std::size_t b = 0; b < files_.size(); ++b) {
      if (files_[b].path.empty()) continue;
      const Matrix4 apart = world_.state().world_from_body[b] - files_[b].path[static_cast<std::size_t>(at)];
      if (apart.topRightCorner<3, 1>().norm() > kApart_m)
        throw DataError("frame {}: body {} was solved {:.3g} mm from where its path has it: of another motion",
                        out_.frames.size(), spec_.bodies[b].name, 1e3 * apart.topRightCorner<3, 1>().norm());
    }
  }

  /// Checks held bodies.
  /// \throw DataError if one would run into another held or fixed body, because no contact acts between them
  void require_free_way(const StepGoal& goal) const {
    const ContactMesh& mesh = world_.mesh();
    const Positions& x = world_.state().motion.x;
    Positions p = Positions::Zero(x.rows(), 3);
    for (const int i : goal.held_bodies) {
      const ObjectPart& object = mesh.objects[static_cast<std::size_t>(i)];
      object.rows(p) = goal.object_target.middleRows(object.first_vertex - mesh.num_gel_vertices, object.num_vertices) -
                       object.rows(x);
    }
    for (const int i : goal.held_bodies) {
      const auto a = static_cast<std::size_t>(i);
      for (std::size_t b = 0; b < mesh.objects.size(); ++b) {
        if (b < world_.num_free() && (b <= a || !World::is_held(goal, b))) continue;
        std::vector<ContactPair> pairs;
        pairs_between(mesh.objects[a].surface, mesh.objects[b].surface, x, p, 0.0, pairs);
        if (contact_step_limit(pairs, x, p, {.slack = 0.01}) < 1.0)
          throw DataError("frame {}: {} runs into {}: both go where the scene says", run_.next(),
                          world_.body(world_.object(a)).name, world_.body(world_.object(b)).name);
      }
    }
  }

  /// Measures and judges a frame, writes its line of the log, and saves it.
  void finish(int phase_index, const StepReport& report) {
    std::vector<Frame> frames =
        world_.measure(phase_index < 0 ? PhaseKind::reference : PhaseKind::path, phase_index, report);
    world_.judge(run_.next(), frames);
    WorldState& state = world_.state();
    SceneFrame frame{.time_s = state.time_s,
                     .phase_index = phase_index,
                     .world_from_body = state.world_from_body,
                     .between = state.between,
                     .min_gap_m = frames[0].min_gap_m,
                     .intersections = frames[0].intersections,
                     .whole = world_.take_account(),
                     .solver = report};
    for (std::size_t i = 0; i < world_.num_free(); ++i) {
      frame.velocity_m_s.push_back(state.motion.object_motion[i].velocity_m_s);
      frame.spin_rad_s.push_back(world_.spin_rad_s(i));
      frame.strain.push_back(strain_of(world_.affine(i), world_.points(i)));
    }
    for (std::size_t b = world_.num_gels(); b < frames.size(); ++b) {
      const SolvedGel soft = world_.deformable(b);
      frame.soft_m.emplace_back(state.motion.x.middleRows(soft.first_row, soft.gel.num_vertices()));
    }
    frames.resize(world_.num_gels());
    log_info("frame {}/{}: {} Newton iterations in {} steps, smallest gap {}", run_.next(), run_.num_frames(),
             report.newton_iterations, report.time_steps, gap_text(frame.min_gap_m));
    run_.save([&] { return pack_frame(frame, frames, state); });
    for (std::size_t g = 0; g < frames.size(); ++g) out_.gels[g].frames.push_back(std::move(frames[g]));
    out_.frames.push_back(std::move(frame));
  }

  const std::vector<SceneBody>& files_;
  const PressConfig& config_;
  const SceneSpec& spec_;
  World world_;
  FrameRun run_;
  Scene out_;
  std::vector<Vector3> loads_n_;  // load on each rigid body at the start of the phase
  int steps_before_ = 0;          // number of time steps of the earlier phases
};

}  // namespace

Scene run_scene(const Sensor& sensor, const std::vector<SceneBody>& bodies, const PressConfig& config,
                const SceneSpec& spec, const ProgressObserver& observe, FrameStore* store) {
  return SceneDrive(sensor, bodies, config, spec, observe, store).run();
}

}  // namespace tacipc
