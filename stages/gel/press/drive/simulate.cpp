#include "stages/gel/press/drive/simulate.h"

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/sample/placement.h"
#include "stages/gel/press/drive/divided_step.h"
#include "stages/gel/press/energy/elasticity.h"
#include "stages/gel/press/measure/front_surface.h"
#include "stages/gel/press/world/setup.h"

namespace tacipc {
namespace {

class Motion {
 public:
  Motion(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
         const SampleSpec& sample, const std::string& default_face, const ProgressObserver& observe, FrameStore* store)
      : sensor_(sensor),
        gel_(gel),
        object_(object),
        config_(config),
        sample_(sample),
        observe_(observe),
        store_(store),
        scales_(scales_of(config, sensor, gel)),
        settings_(step_settings(config, scales_)),
        compliance_m_n_(sensor.mount.compliance()),
        rest_tets_(make_rest_tets(gel.positions, gel.tets)) {
    check_motion(sample, sensor, config);
    closed_ = check_object(object, config);
    for (const Phase& phase : sample.motion) num_frames_ += phase.steps;
    out_.d_hat_m = scales_.d_hat_m;
    out_.gap_horizon_m = scales_.gap_horizon_m;
    out_.barrier_stiffness = scales_.barrier_stiffness;
    out_.newton = settings_.newton;
    out_.element = element_of(config, sensor.material);
    out_.face = sample.face.value_or(default_face);
    if (sample.density_kg_m3) {
      out_.object_mass_kg = *sample.density_kg_m3 * signed_volume(object);
      if (!(out_.object_mass_kg > 0.0)) throw DataError("the object encloses no volume, so it has no mass");
    }
    out_.front = make_front_surface(gel);
    if (std::any_of(sample.motion.begin(), sample.motion.end(),
                    [](const Phase& phase) { return phase.kind == PhaseKind::free; })) {
      if (!closed_) throw DataError("the object is not closed: where it moves freely its surface says how heavy it is");
      body_ = make_affine_body(object.positions, object.triangles, *sample.density_kg_m3);
    }
    out_.object_may_be_free = body_.has_value();
    out_.mount_gives_way = sensor.mount.gives_way();
    placed_ = place(object.positions, {out_.face, sample.rotate_rad, sample.center_x_m, sample.center_y_m},
                    scales_.start_gap_m);
    mesh_ = make_contact_mesh(gel.positions, gel.boundary, transformed(placed_, object.positions), object.triangles);
    if (body_) mesh_.num_control_points = 4;
  }

  Simulation run() {
    TimeStepper stepper(mesh_, make_gel_model({{sensor_.material, out_.element, gel_}}), settings_,
                        body_ ? std::vector{*body_} : std::vector<AffineBody>{});
    stepper_ = &stepper;
    progress_.state = {.x = Positions(mesh_.num_rows(), 3), .velocity_m_s = Positions::Zero(gel_.num_vertices(), 3)};
    progress_.state.x.topRows(mesh_.num_vertices()) = mesh_.rest_positions;
    if (body_) mesh_.control_rows(progress_.state.x) = control_at(placed_);
    pose_ = holder_ = placed_;
    if (const double gap = stepper.smallest_gap(progress_.state.x, scales_.gap_horizon_m); gap <= scales_.d_hat_m) {
      throw DataError("the object is {:.3g} m from the gel in frame 0, nearer than d_hat = {:.3g} m", gap,
                      scales_.d_hat_m);
    }
    if (!restored()) finish({}, stepper.no_forces());
    PhaseStart start{};
    for (std::size_t p = 0; p < sample_.motion.size(); ++p) {
      const Phase& phase = sample_.motion[p];
      const std::array<bool, 3> free = start.free;
      const Vector3 load_n = start.load_n;
      start = phase_start(sample_, object_.positions, placed_, holder_, scales_.start_gap_m);
      start.free = free;
      start.load_n = load_n;
      progress_.object_shift_m = pose_.topRightCorner<3, 1>() - holder_.topRightCorner<3, 1>();
      const double phase_start_s = time_s_;
      for (int index = 1; index <= phase.steps; ++index) {
        if (!restored()) run_frame(phase, static_cast<int>(p), index, start, phase_start_s);
      }
      const Goal last = goal_of(phase, time_steps(phase), start, config_.time_step_s);
      start.free = last.free;
      start.load_n = last.load_n;
    }
    out_.symbolic_analyses = stepper.num_analyses();
    out_.times = stepper.times();
    return std::move(out_);
  }

 private:
  /// Advances from `from` to `to`, in time steps since the start of the phase; divides the step in two where it does
  /// not converge.
  void advance(const Phase& phase, const PhaseStart& start, double from, double to, int halvings, StepReport& report) {
    Goal goal = goal_of(phase, to, start, config_.time_step_s);
    const Vector3 held = goal.gel_from_object.topRightCorner<3, 1>();
    goal.gel_from_object.topRightCorner<3, 1>() += progress_.object_shift_m;
    StepGoal step{.h_s = (to - from) * goal.duration_s,
                  .object_target = transformed(goal.gel_from_object, object_.positions),
                  .load_n = goal.load_n,
                  .object_mass_kg = out_.object_mass_kg,
                  .free_object = phase.kind == PhaseKind::free};
    if (body_) step.control_target = control_at(goal.gel_from_object);
    for (int axis = 0; axis < 3; ++axis) {
      const bool on_mount = !goal.free[axis] && compliance_m_n_[axis] > 0.0;
      if (goal.free[axis] || on_mount) step.free_axes.push_back(axis);
      if (!on_mount) continue;
      step.mount_stiffness_n_m[axis] = 1.0 / compliance_m_n_[axis];
      step.mount_shift_m[axis] = progress_.object_shift_m[axis];
    }
    const auto advance_whole = [&] {
      StepReport done = stepper_->advance(progress_.state, step, [&](int iteration, double residual) {
        observe_(static_cast<int>(out_.frames.size()), num_frames_, iteration, residual);
      });
      progress_.object_shift_m += done.object_shift_m;
      if (step.free_object) {
        pose_ = pose_of(*body_, mesh_.control_rows(progress_.state.x));
      } else {
        pose_ = goal.gel_from_object;
        pose_.topRightCorner<3, 1>() += done.object_shift_m;
      }
      find_holder(goal, held);
      return done;
    };
    advance_or_divide(out_.frames.size(), halvings, config_.max_halvings, report, advance_whole, [&](int deeper) {
      const double middle = 0.5 * (from + to);
      advance(phase, start, from, middle, deeper, report);
      advance(phase, start, middle, to, deeper, report);
    });
  }

  /// Where a rigid mount would have the object after a step: along axes of a load, as far from it as the mount gives
  /// way to the force.
  void find_holder(const Goal& goal, const Vector3& held_m) {
    holder_ = pose_;
    if (!out_.mount_gives_way) return;
    const StepForces& forces = stepper_->forces();
    const Vector3 on_gel_n = forces.normal.colwise().sum() + forces.friction.colwise().sum();
    for (int axis = 0; axis < 3; ++axis) {
      if (compliance_m_n_[axis] > 0.0)
        holder_(axis, 3) = goal.free[axis] ? pose_(axis, 3) + compliance_m_n_[axis] * on_gel_n[axis] : held_m[axis];
    }
  }

  /// Where the points that carry the object are when it is at a pose.
  ControlPoints control_at(const Matrix4& pose) const { return transformed(pose, body_->rest_m); }

  void run_frame(const Phase& phase, int phase_index, int index, const PhaseStart& start, double phase_start_s) {
    Frame frame;
    frame.phase_index = phase_index;
    try {
      for (int k = 0; k < phase.substeps; ++k) {
        const double from = (index - 1) * phase.substeps + k;
        advance(phase, start, from, from + 1.0, 0, frame.solver);
      }
    } catch (const SolverError& error) {
      throw SolverError("frame {}: {}", out_.frames.size(), error.what());
    }
    // Not summed step by step, so that rounding errors do not add up.
    time_s_ = phase_start_s + (phase.kind == PhaseKind::path ? phase.points[static_cast<std::size_t>(index)].time_s
                                                             : index * phase.substeps * config_.time_step_s);
    frame.phase = phase.kind;
    finish(std::move(frame), stepper_->forces());
  }

  /// Takes the next frame from an interrupted run, if that has one.
  bool restored() {
    Frame frame;
    if (!store_ || !restoring_) return false;
    restoring_ = store_->load(frame, progress_);
    if (!restoring_) return false;
    pose_ = frame.gel_from_object;
    holder_ = frame.holder_pose;
    time_s_ = frame.time_s;
    touched_ = touched_ || frame.balance.contact_n != Vector3::Zero();
    log_info("frame {}/{} resumed from an interrupted run", out_.frames.size(), num_frames_);
    out_.frames.push_back(std::move(frame));
    return true;
  }

  /// Measures and judges a frame, keeps it, and writes its line of the log.
  void finish(Frame frame, const StepForces& forces) {
    const Positions& x = progress_.state.x;
    frame.positions = x.topRows(gel_.num_vertices());
    frame.gel_from_object = pose_;
    frame.holder_pose = holder_;
    frame.time_s = time_s_;
    frame.normal_force_n = on_front(out_.front, forces.normal);
    frame.friction_force_n = on_front(out_.front, forces.friction);
    for (const int v : out_.front.vertices)
      frame.contact_state.push_back(forces.contact_state[static_cast<std::size_t>(v)]);
    const Positions contact = forces.normal + forces.friction;
    for (Eigen::Index v = 0; v < contact.rows(); ++v) {
      const Vector3 force = contact.row(v), arm = frame.positions.row(v);
      frame.force_n += force;
      frame.torque_n_m += arm.cross(force);
    }
    frame.balance = balance_of(frame.positions, {.contact = contact, .inertia = forces.body, .mount = forces.mount});
    touched_ = touched_ || frame.balance.contact_n != Vector3::Zero();
    if (frame.phase == PhaseKind::press && !touched_) frame.phase = PhaseKind::approach;
    // A free object is what its points make of it, a rigid one but for its strain.
    const bool free = frame.phase == PhaseKind::free;
    const Positions object_positions = free ? Positions(mesh_.object_rows(x)) : transformed(pose_, object_.positions);
    frame.pose_error_m = (mesh_.object_rows(x) - object_positions).rowwise().norm().maxCoeff();
    if (body_) {
      const ControlPoints points = mesh_.control_rows(x);
      if (free) frame.body_strain = strain_of(*body_, points);
      frame.object_velocity_m_s = progress_.state.object_motion[0].velocity_m_s;
      frame.object_spin_rad_s = angular_velocity(*body_, points, progress_.state.object_motion[0]);
    }
    frame.min_gap_m = stepper_->smallest_gap(x, scales_.gap_horizon_m);
    frame.stand_off_m = forces.stand_off_m;
    frame.min_volume_ratio = min_volume_ratio(frame.positions, gel_.tets, rest_tets_);
    const IntersectionReport crossings =
        find_intersections({frame.positions, gel_.boundary}, {object_positions, object_.triangles});
    frame.intersections = static_cast<int>(crossings.gel_object + crossings.gel_gel);
    if (closed_)
      frame.gel_in_object =
          winding_number(frame.positions.row(out_.front.vertices[0]), {object_positions, object_.triangles});
    frame.inverted_tets = static_cast<int>(count_inverted_tets(frame.positions, gel_.tets));
    judge_frame(static_cast<int>(out_.frames.size()), numbers_of(frame),
                limits_of(config_, settings_.newton, frame.solver.contact_force_n));
    log_info(
        "frame {}/{} {}: press {:.4f} N, tangential {:.4f} N, {} Newton iterations in {} steps, "
        "smallest gap {:.3g} um, smallest volume ratio {:.3f}",
        out_.frames.size(), num_frames_, name_of(frame.phase), 0.0 - frame.force_n.z(), frame.force_n.head<2>().norm(),
        frame.solver.newton_iterations, frame.solver.time_steps, 1e6 * frame.min_gap_m, frame.min_volume_ratio);
    if (store_) store_->save(frame, progress_);
    out_.frames.push_back(std::move(frame));
  }

  const Sensor& sensor_;
  const TetMesh& gel_;
  const TriangleMesh& object_;
  const PressConfig& config_;
  const SampleSpec& sample_;
  const ProgressObserver& observe_;
  FrameStore* store_;
  const Scales scales_;
  const StepSettings settings_;
  const Vector3 compliance_m_n_;  // of the sensor's mount
  const std::vector<RestTet> rest_tets_;
  Simulation out_;
  ContactMesh mesh_;
  std::optional<AffineBody> body_;  // the object, where it is free in any phase
  TimeStepper* stepper_ = nullptr;
  double time_s_ = 0.0;
  Matrix4 placed_, pose_, holder_;
  int num_frames_ = 0;
  bool touched_ = false, restoring_ = true, closed_ = false;
  Progress progress_;
};

}  // namespace

FrameNumbers numbers_of(const Frame& frame) {
  return {
      .min_gap_m = frame.min_gap_m,
      .intersections = frame.intersections,
      .inverted_tets = frame.inverted_tets,
      .gel_in_object = frame.gel_in_object,
      .min_volume_ratio = frame.min_volume_ratio,
      .velocity_residual_m_s = frame.solver.velocity_residual_m_s,
      .force_residual_n = frame.solver.force_residual_n,
      .friction_residual_n = frame.solver.friction_residual_n,
      .balance_n = frame.balance.force_n,
      .balance_relative = frame.balance.relative,
      .pose_error_m = frame.pose_error_m,
      .body_strain = frame.body_strain,
      .body_balance_relative = frame.solver.body_residual_n / std::max(frame.solver.body_load_n, kSmallestBodyLoadN)};
}

SolverLimits limits_of(const PressConfig& config, const NewtonSettings& newton, double contact_force_n) {
  SolverLimits limits{.velocity_residual_m_s = newton.velocity_tolerance_m_s,
                      .force_residual_n = newton.force_limit_n(contact_force_n),
                      .friction_residual_n = {}};
  if (config.friction && config.friction->iterated)
    limits.friction_residual_n =
        std::max(newton.force_tolerance_n, config.friction->relative_lag_tolerance * contact_force_n);
  return limits;
}

Simulation simulate(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
                    const SampleSpec& sample, const std::string& default_face, const ProgressObserver& observe,
                    FrameStore* store) {
  return Motion(sensor, gel, object, config, sample, default_face, observe, store).run();
}

}  // namespace tacipc
