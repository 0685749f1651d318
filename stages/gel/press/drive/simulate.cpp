#include "stages/gel/press/drive/simulate.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/sample/placement.h"
#include "stages/gel/press/contact/intersection_check.h"
#include "stages/gel/press/drive/checkpoint.h"

namespace tacipc {
namespace {

constexpr std::size_t kObject = 1;  // index of the object's body; the gel is body 0

bool has_free_phase(const SampleSpec& sample) {
  return std::any_of(sample.motion.begin(), sample.motion.end(),
                     [](const Phase& phase) { return phase.kind == PhaseKind::free; });
}

/// Mass of the object; 0 if the sample gives no density. \throw DataError if it encloses no volume
double mass_of(const TriangleMesh& object, const SampleSpec& sample) {
  if (!sample.density_kg_m3) return 0.0;
  const double mass_kg = *sample.density_kg_m3 * signed_volume(object);
  if (!(mass_kg > 0.0)) throw DataError("the object encloses no volume, so it has no mass");
  return mass_kg;
}

/// Bodies in frame 0: the gel at the origin and the object above it.
std::vector<Body> bodies_of(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object,
                            const PressConfig& config, const SampleSpec& sample, const std::string& default_face) {
  check_motion(sample, sensor, config);
  Body pressed{.name = "object", .surface = object, .closed = check_object(object, config)};
  mass_of(object, sample);
  if (has_free_phase(sample)) {
    if (!pressed.closed)
      throw DataError("the object is not closed: where it moves freely its surface says how heavy it is");
    pressed.affine = make_affine_body(object.positions, object.triangles, *sample.density_kg_m3);
  }
  pressed.start = place(object.positions,
                        {sample.face.value_or(default_face), sample.rotate_rad, sample.center_x_m, sample.center_y_m},
                        scales_of(config, sensor, gel).start_gap_m);
  return {{.name = "gel", .tets = gel, .material = sensor.material}, std::move(pressed)};
}

class Press {
 public:
  Press(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
        const SampleSpec& sample, const std::string& default_face, const ProgressObserver& observe, FrameStore* store)
      : object_(object),
        config_(config),
        sample_(sample),
        compliance_m_n_(sensor.mount.compliance()),
        world_(sensor, config, bodies_of(sensor, gel, object, config, sample, default_face),
               {.gravity_m_s2 = config.gravity_m_s2, .mounts_move = false}),
        run_(num_frames(sample.motion), observe, store),
        placed_(pose()),
        holder_(pose()) {
    out_ = world_.simulation_of(0);
    out_.mount_gives_way = sensor.mount.gives_way();
    out_.face = sample.face.value_or(default_face);
    out_.object_mass_kg = mass_of(object, sample);
  }

  Simulation run() {
    if (!restored()) {
      world_.require_apart();
      finish(PhaseKind::reference, -1, {});
    }
    PhaseStart start{};
    for (std::size_t p = 0; p < sample_.motion.size(); ++p) {
      const Phase& phase = sample_.motion[p];
      const std::array<bool, 3> free = start.free;
      const Vector3 load_n = start.load_n;
      start = phase_start(sample_, object_.positions, placed_, holder_, world_.scales().start_gap_m);
      start.free = free;
      start.load_n = load_n;
      shift_m_ = pose().topRightCorner<3, 1>() - holder_.topRightCorner<3, 1>();
      const double phase_start_s = world_.state().time_s;
      for (int index = 1; index <= phase.steps; ++index) {
        if (!restored()) run_frame(phase, static_cast<int>(p), index, start, phase_start_s);
      }
      const Goal last = goal_of(phase, time_steps(phase), start, config_.time_step_s);
      start.free = last.free;
      start.load_n = last.load_n;
    }
    require_contact();
    out_.times = world_.stepper().times();
    return std::move(out_);
  }

 private:
  Matrix4& pose() { return world_.state().world_from_body[kObject]; }
  bool may_be_free() const { return world_.num_free() > 0; }

  /// Goal of a time step of `h_s` seconds.
  /// \param goal goal at the end of the phase, shifted by the object's displacement so far
  StepGoal step_goal(const Phase& phase, const Goal& goal, double h_s) const {
    StepGoal step{.h_s = h_s,
                  .object_target = transformed(goal.gel_from_object, object_.positions),
                  .load_n = goal.load_n,
                  .object_mass_kg = out_.object_mass_kg,
                  .free_object = phase.kind == PhaseKind::free};
    if (may_be_free()) step.control_target = world_.points_at(0, goal.gel_from_object);
    for (int axis = 0; axis < 3; ++axis) {
      const bool on_mount = !goal.free[axis] && compliance_m_n_[axis] > 0.0;
      if (goal.free[axis] || on_mount) step.free_axes.push_back(axis);
      if (!on_mount) continue;
      step.mount_stiffness_n_m[axis] = 1.0 / compliance_m_n_[axis];
      step.mount_shift_m[axis] = shift_m_[axis];
    }
    return step;
  }

  /// Advances from `from` to `to`, in time steps since the start of the phase; divides the step in two if it does not
  /// converge.
  void advance(const Phase& phase, const PhaseStart& start, double from, double to, int halvings, StepReport& report) {
    Goal goal = goal_of(phase, to, start, config_.time_step_s);
    const Vector3 held_m = goal.gel_from_object.topRightCorner<3, 1>();
    goal.gel_from_object.topRightCorner<3, 1>() += shift_m_;
    const StepGoal step = step_goal(phase, goal, (to - from) * goal.duration_s);
    const auto advance_whole = [&] {
      StepReport done = world_.advance(step, {Matrix4::Identity(), goal.gel_from_object}, run_.observer());
      shift_m_ += done.object_shift_m;
      if (!step.free_object) pose().topRightCorner<3, 1>() += done.object_shift_m;
      find_holder(goal, held_m);
      return done;
    };
    run_.advance_or_divide(halvings, config_.max_halvings, report, advance_whole, [&](int deeper) {
      const double middle = 0.5 * (from + to);
      advance(phase, start, from, middle, deeper, report);
      advance(phase, start, middle, to, deeper, report);
    });
  }

  /// Computes the object pose on a rigid mount after a step: along axes of a load, it differs from the object's pose by
  /// the mount's deflection under the force.
  void find_holder(const Goal& goal, const Vector3& held_m) {
    holder_ = pose();
    if (!out_.mount_gives_way) return;
    const StepForces& forces = world_.forces();
    const Vector3 on_gel_n = forces.normal.colwise().sum() + forces.friction.colwise().sum();
    for (int axis = 0; axis < 3; ++axis) {
      if (compliance_m_n_[axis] > 0.0)
        holder_(axis, 3) = goal.free[axis] ? pose()(axis, 3) + compliance_m_n_[axis] * on_gel_n[axis] : held_m[axis];
    }
  }

  void run_frame(const Phase& phase, int phase_index, int index, const PhaseStart& start, double phase_start_s) {
    const StepReport report = run_.solve([&](StepReport& sum) {
      for (int k = 0; k < phase.substeps; ++k) {
        const double from = (index - 1) * phase.substeps + k;
        advance(phase, start, from, from + 1.0, 0, sum);
      }
    });
    // Computed from the start of the phase instead of summed, so that rounding errors do not add up.
    world_.state().time_s =
        phase_start_s + (phase.kind == PhaseKind::path ? phase.points[static_cast<std::size_t>(index)].time_s
                                                       : index * phase.substeps * config_.time_step_s);
    finish(phase.kind, phase_index, report);
  }

  /// Checks contact: an object that went below the undeformed front without touching the gel missed it.
  void require_contact() const {
    if (std::any_of(out_.frames.begin(), out_.frames.end(), touches)) return;
    Vector3 deepest_m = Vector3::Zero();
    for (const Frame& frame : out_.frames) {
      const Positions at = transformed(frame.gel_from_object, object_.positions);
      Eigen::Index lowest = 0;
      if (at.col(2).minCoeff(&lowest) < deepest_m.z()) deepest_m = at.row(lowest).transpose();
    }
    if (!sample_.may_miss && deepest_m.z() < 0.0) {
      const Positions front = on_front(out_.front, world_.body(0).tets.positions);
      fail_untouched(run_.next() - 1, deepest_m, front.colwise().minCoeff().head<2>().transpose(),
                     front.colwise().maxCoeff().head<2>().transpose());
    }
    log_warning("nothing touched the gel in any frame");
  }

  bool restored() {
    const std::optional<std::string> bytes = run_.restored();
    if (!bytes) return false;
    Frame frame;
    PressProgress progress;
    unpack_frame(*bytes, frame, progress);
    world_.state() = std::move(progress.world);
    holder_ = frame.holder_pose;
    shift_m_ = progress.object_shift_m;
    touched_ = touched_ || frame.balance.contact_n != Vector3::Zero();
    out_.frames.push_back(std::move(frame));
    return true;
  }

  /// Measures and judges a frame, writes its line of the log, and saves it.
  void finish(PhaseKind phase, int phase_index, const StepReport& report) {
    std::vector<Frame> frames = world_.measure(phase, phase_index, report);
    Frame& frame = frames[0];
    frame.holder_pose = holder_;
    touched_ = touched_ || frame.balance.contact_n != Vector3::Zero();
    if (frame.phase == PhaseKind::press && !touched_) frame.phase = PhaseKind::approach;
    // The pose of a free object follows from its control points; for any other object the points follow from the pose.
    const bool free = frame.phase == PhaseKind::free;
    const Positions at = world_.mesh().object_rows(world_.state().motion.x);
    const Positions prescribed = free ? at : transformed(pose(), object_.positions);
    frame.pose_error_m = (at - prescribed).rowwise().norm().maxCoeff();
    if (!free) frame.body_strain = 0.0;
    if (world_.body(kObject).closed)
      frame.gel_in_object =
          winding_number(frame.positions.row(out_.front.vertices[0]), {prescribed, object_.triangles});
    world_.judge(run_.next(), frames);
    log_info(
        "frame {}/{} {}: press {:.4f} N, tangential {:.4f} N, {} Newton iterations in {} steps, "
        "smallest gap {}, smallest volume ratio {:.3f}",
        run_.next(), run_.num_frames(), name_of(frame.phase), 0.0 - frame.force_n.z(), frame.force_n.head<2>().norm(),
        frame.solver.newton_iterations, frame.solver.time_steps, gap_text(frame.min_gap_m), frame.min_volume_ratio);
    run_.save([&] { return pack_frame(frame, {world_.state(), shift_m_}); });
    out_.frames.push_back(std::move(frame));
  }

  const TriangleMesh& object_;
  const PressConfig& config_;
  const SampleSpec& sample_;
  const Vector3 compliance_m_n_;  // compliance of the sensor's mount
  World world_;
  FrameRun run_;
  Simulation out_;
  Matrix4 placed_, holder_;  // object pose in frame 0, and object pose on a rigid mount
  Vector3 shift_m_ = Vector3::Zero();
  bool touched_ = false;
};

}  // namespace

Simulation simulate(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
                    const SampleSpec& sample, const std::string& default_face, const ProgressObserver& observe,
                    FrameStore* store) {
  return Press(sensor, gel, object, config, sample, default_face, observe, store).run();
}

}  // namespace tacipc
