#include "stages/gel/press/drive/grasp.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/mesh/mass_properties.h"
#include "common/sample/placement.h"
#include "common/sample/rigid_way.h"
#include "stages/gel/press/drive/checkpoint.h"
#include "stages/gel/press/drive/divided_step.h"
#include "stages/gel/press/drive/grasp_labels.h"
#include "stages/gel/press/drive/grasp_outcome.h"
#include "stages/gel/press/world/gel_frame.h"
#include "stages/gel/press/world/setup.h"

namespace tacipc {
namespace {

constexpr int kMostClosingSteps = 200;  // after the frames of a phase in which fingers close
constexpr double kMostTurn_rad = 0.2;   // of the hand in a time step: a straight path cuts 0.5 % off at most
/// z of S is x of the world for the left finger and −x for the right one; the images' down, y, is the world's.
Matrix3 world_from_finger(int side) {
  const Vector3 z = side == 0 ? Vector3::UnitX() : Vector3(-Vector3::UnitX()), y = -Vector3::UnitZ();
  Matrix3 R;
  R << y.cross(z), y, z;
  return R;
}

/// How far the fingers close.
using Ways = std::array<double, 2>;

/// How hard a finger is pressed by a force.
double pressing_n(const Vector3& force_n, const Matrix4& world_from_finger) {
  return std::abs(force_n.dot(world_from_finger.col(2).head<3>()));
}

class Hand {
 public:
  Hand(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
       const GraspSpec& spec, const ProgressObserver& observe, ByteStore* store)
      : sensor_(sensor),
        gel_(gel),
        object_(object),
        config_(spec.pressed_with(config)),
        spec_(spec),
        observe_(observe),
        store_(store),
        scales_(scales_of(config_, sensor, gel)),
        settings_(step_settings(config_, scales_)),
        start_gap_m_(spec.start_gap_m.value_or(scales_.start_gap_m)),
        rest_tets_(make_rest_tets(gel.positions, gel.tets)) {
    require_rigid_mount(sensor);
    if (config.augmented_lagrangian)
      throw UsageError(
          "constraints: augmented_lagrangian holds gels and object to their poses; a grasp needs elimination");
    if (config.gravity_m_s2 != Vector3::Zero())
      throw UsageError(
          "gravity_m_s2 is along the axes of one gel; a grasp has it in the sample, in fingers.gravity_m_s2");
    if (config.mass_damping_per_s > 0.0) throw UsageError("damping.mass_per_s would hold back fingers that move");
    if (!config.friction) log_warning("the press file has no friction: nothing can be lifted by it");
    if (!check_object(object, config))
      throw DataError(
          "the object is not closed: its mass and inertia are those of the volume it encloses; close the mesh, or "
          "WRAP=yes");
    settings_.gravity_m_s2 = spec.gravity_m_s2;
    for (const GraspPhase& phase : spec.motion) num_frames_ += phase.steps;
    place_all();
  }

  Grasp run() {
    const std::string element = element_of(config_, sensor_.material);
    model_ = make_gel_model({{sensor_.material, element, both_}});
    TimeStepper stepper(mesh_, model_, settings_, {*body_});
    stepper_ = &stepper;
    for (Simulation& finger : out_.fingers) {
      finger.d_hat_m = scales_.d_hat_m;
      finger.gap_horizon_m = scales_.gap_horizon_m;
      finger.barrier_stiffness = scales_.barrier_stiffness;
      finger.newton = settings_.newton;
      finger.element = element;
      finger.object_mass_kg = body_->mass_kg;
      finger.object_may_be_free = true;
      finger.front = make_front_surface(gel_);
    }
    State& state = progress_.state;
    state.x.resize(mesh_.num_rows(), 3);
    state.x << mesh_.rest_positions, control_at(world_from_object_);
    state.velocity_m_s = Positions::Zero(both_.num_vertices(), 3);
    if (stepper.smallest_gap(state.x, scales_.gap_horizon_m) <= scales_.d_hat_m)
      throw DataError("the object is nearer to a finger than d_hat = {:.3g} m in frame 0", scales_.d_hat_m);
    progress_.mount_n = Positions::Zero(both_.num_vertices(), 3);
    whole_ = open_account(model_.mass_kg, instant(), spec_.gravity_m_s2, model_.elasticity->value(state.x));
    if (!restored()) finish(PhaseKind::reference, -1, {}, stepper.no_forces());
    for (std::size_t p = 0; p < spec_.motion.size(); ++p) run_phase(spec_.motion[p], static_cast<int>(p));
    for (Simulation& finger : out_.fingers) finger.times = stepper.times();
    out_.grip_n = progress_.grip_n;
    out_.freed_frame = *grip_frame_;
    judge_outcome();
    return std::move(out_);
  }

 private:
  /// Turns the object, hangs its grip point at the origin and puts the fingers beside it.
  void place_all() {
    const MassProperties mass = spec_.mass_of(object_);
    const double friction = config_.coefficient_of_friction();
    body_ = make_affine_body(object_.positions, object_.triangles, spec_.density_of(mass.volume_m3, friction),
                             spec_.center_shift_m);
    out_.friction = friction;
    out_.gravity_m_s2 = spec_.gravity_m_s2;
    out_.center_shift_m = spec_.center_shift_m;
    out_.mass_kg = body_->mass_kg;
    out_.weight_n = body_->mass_kg * spec_.gravity_m_s2.norm();
    out_.center_of_mass_m = mass.center_m;
    out_.pose = spec_.pose_of(object_, mass, sensor_.gel, friction);
    const Matrix3& turn = out_.pose.world_from_object;
    world_from_object_.setIdentity();
    world_from_object_.topLeftCorner<3, 3>() = turn;
    world_from_object_.topRightCorner<3, 1>() = -turn * out_.grip_point();
    const Positions at = transformed(world_from_object_, object_.positions);
    // How far the object reaches towards each finger within what the finger can touch.
    const Eigen::RowVector3d low = gel_.positions.colwise().minCoeff(), high = gel_.positions.colwise().maxCoeff();
    for (int side = 0; side < 2; ++side) {
      const Matrix3 R = world_from_finger(side);
      const Positions seen = at * R;  // in the axes of the finger
      double reach = -std::numeric_limits<double>::infinity();
      for (Eigen::Index t = 0; t < object_.num_triangles(); ++t) {
        Eigen::AlignedBox3d box;
        for (int k = 0; k < 3; ++k) box.extend(Vector3(seen.row(object_.triangles(t, k))));
        const bool within = box.min().x() <= high.x() && box.max().x() >= low.x() && box.min().y() <= high.y() &&
                            box.max().y() >= low.y();
        if (within) reach = std::max(reach, -box.min().z());
      }
      if (!std::isfinite(reach))
        throw DataError(
            "there is nothing of the object between the fingers at the grip point: fingers.grip_mm (GRIP) is measured "
            "from the centre of mass, in the object's axes");
      start_[side].setIdentity();
      start_[side].topLeftCorner<3, 3>() = R;
      start_[side].topRightCorner<3, 1>() = -R.col(2) * (reach + start_gap_m_);
    }
    both_ = joined(std::array{PlacedGel{gel_, start_[0]}, PlacedGel{gel_, start_[1]}});
    mesh_ = make_contact_mesh(both_.positions, both_.boundary, at, object_.triangles);
    mesh_.num_control_points = 4;
    const int anchor = gel_.vertices(BoundaryTag::glued).front();
    const auto alone = std::make_shared<const ContactMesh>(
        make_contact_mesh(gel_.positions, gel_.boundary, Positions(0, 3), Triangles(0, 3)));
    for (int side = 0; side < 2; ++side) {
      mesh_.gels.push_back({side * static_cast<int>(gel_.num_vertices()), anchor, alone});
    }
    glued_ = both_.vertices(BoundaryTag::glued);
    start_width_m_ = start_[1](0, 3) - start_[0](0, 3);
  }

  ControlPoints control_at(const Matrix4& pose) const { return transformed(pose, body_->rest_m); }

  SolvedGel part(std::size_t side) const {
    return {gel_, out_.fingers[side].front, rest_tets_, static_cast<Eigen::Index>(side) * gel_.num_vertices()};
  }

  std::array<Matrix4, 2> finger_poses(const Matrix4& world_from_hand, const Ways& closed_m) const {
    std::array<Matrix4, 2> poses = start_;
    for (const std::size_t side : {0, 1}) {
      Matrix4& pose = poses[side];
      pose.topRightCorner<3, 1>() += closed_m[side] * pose.topLeftCorner<3, 3>().col(2);
      pose = world_from_hand * pose;
    }
    return poses;
  }
  Ways closed() const { return {progress_.drives[0].closed_m, progress_.drives[1].closed_m}; }
  std::array<Matrix4, 2> finger_poses() const { return finger_poses(progress_.world_from_hand, closed()); }

  /// By which each drive is controlled: one for both by their mean.
  Ways grips_n() const {
    const auto poses = finger_poses();
    Ways grips{pressing_n(force_on(0), poses[0]), pressing_n(force_on(1), poses[1])};
    if (!spec_.drive_each) grips.fill(0.5 * (grips[0] + grips[1]));
    return grips;
  }
  double grip_n() const {
    const Ways grips = grips_n();
    return 0.5 * (grips[0] + grips[1]);
  }

  bool is_free() const { return progress_.drives[0].let_go; }
  /// Whether the object is free and neither finger touches it: fingers neither close nor open any further then, except
  /// in a release.
  bool lost() const { return progress_.drives[0].lost() && progress_.drives[1].lost(); }
  bool arrived() const {
    const auto& [left, right] = progress_.drives;
    if (left.by_way || !is_free()) return left.arrived(spec_.mount) && right.arrived(spec_.mount);
    // Drives of their own may float with the object for ever, with what their damping takes between their grips.
    GripControl mean = left;
    mean.last_grip_n = grip_n();
    mean.velocity_m_s = 0.5 * (left.velocity_m_s + right.velocity_m_s);
    return mean.arrived(spec_.mount);
  }

  Vector3 force_on(std::size_t side) const { return contact_force_on(part(side), stepper_->forces()); }

  /// One time step, in which the hand moves and the fingers close; divided where it turns too far for straight paths of
  /// the vertices, or does not converge.
  void step(double h, const Ways& closing_m, const RigidWay& hand, int halvings, StepReport& report) {
    if (hand.turn_rad.norm() > kMostTurn_rad) return both_halves(h, closing_m, hand, halvings, report);
    const Ways closed{progress_.drives[0].closed_m + closing_m[0], progress_.drives[1].closed_m + closing_m[1]};
    const Matrix4 to = moved(progress_.world_from_hand, hand);
    const std::array<Matrix4, 2> before = finger_poses(), poses = finger_poses(to, closed);
    const auto n = static_cast<int>(gel_.num_vertices());
    Positions target(2 * n, 3), start(2 * n, 3);
    target << transformed(poses[0], gel_.positions), transformed(poses[1], gel_.positions);
    start << transformed(before[0], gel_.positions), transformed(before[1], gel_.positions);
    StepGoal goal{.h_s = h,
                  .object_target = transformed(world_from_object_, object_.positions),
                  .free_object = is_free(),
                  .gel_motion = target - start,
                  .glued_target = target(glued_, Eigen::all),
                  .hand_motion = motion_of_world(progress_.world_from_hand, hand),
                  .world_from_gel = {poses[0].topLeftCorner<3, 3>(), poses[1].topLeftCorner<3, 3>()},
                  .control_target = control_at(world_from_object_)};
    if (goal.gel_motion.isZero(0.0)) goal.gel_motion.resize(0, 3);
    const WholeInstant at_start = instant();
    const auto advance = [&] {
      const StepReport done = stepper_->advance(progress_.state, goal, [&](int iteration, double residual) {
        observe_(static_cast<int>(out_.frames.size()), num_frames_, iteration, residual);
      });
      for (const std::size_t side : {0, 1}) progress_.drives[side].closed_m = closed[side];
      progress_.world_from_hand = to;
      note_step(at_start, h);
      if (is_free()) world_from_object_ = pose_of(*body_, mesh_.control_rows(progress_.state.x));
      return done;
    };
    advance_or_divide(out_.frames.size(), halvings, config_.max_halvings, report, advance,
                      [&](int deeper) { both_halves(h, closing_m, hand, deeper, report); });
  }

  void both_halves(double h, const Ways& closing_m, const RigidWay& hand, int halvings, StepReport& report) {
    for (int half = 0; half < 2; ++half)
      step(0.5 * h, {0.5 * closing_m[0], 0.5 * closing_m[1]}, hand * 0.5, halvings, report);
  }

  WholeInstant instant() const {
    const State& state = progress_.state;
    return {state.x.topRows(both_.num_vertices()),
            state.velocity_m_s,
            {{&*body_, mesh_.control_rows(state.x), state.object_motion[0], !is_free()}}};
  }

  /// Energy and momentum of a time step that succeeded.
  void note_step(const WholeInstant& before, double h) {
    const StepForces& forces = stepper_->forces();
    const WholeInstant after = instant();
    StepExchange exchange = exchange_of(h, forces, progress_.mount_n, model_.elasticity->value(progress_.state.x));
    if (!is_free()) {
      // Whoever holds the object passes its contact forces on, and does no work: it rests.
      for (Eigen::Index v = 0; v < after.gel_m.rows(); ++v) {
        const Vector3 force = forces.normal.row(v) + forces.friction.row(v), at = after.gel_m.row(v);
        exchange.others.force_n += force;
        exchange.others.torque_n_m += at.cross(force);
      }
    }
    add_step(whole_, model_.mass_kg, before, after, spec_.gravity_m_s2, exchange);
    progress_.mount_n = forces.mount;
  }

  /// How the hand has moved after a part of a phase.
  static RigidWay hand_in(const GraspPhase& phase, double part, double seconds) {
    RigidWay hand;
    const double smooth = smooth_part(part);
    if (phase.kind == PhaseKind::lift) hand.shift_m.z() = phase.distance_m * smooth;
    if (phase.kind == PhaseKind::shake)
      hand.shift_m[phase.axis] =
          0.5 * phase.amplitude_m * (1.0 - std::cos(2.0 * std::numbers::pi * phase.frequency_hz * seconds));
    if (phase.kind == PhaseKind::turn) hand.turn_rad[phase.axis] = phase.angle_rad * smooth;
    return hand;
  }

  /// What the fingers are to have done after a part of a phase, from what they had at its start.
  void set_goal(const GraspPhase& phase, double part, const std::array<GripControl, 2>& from) {
    const double mean_m = 0.5 * (from[0].closed_m + from[1].closed_m);
    for (const std::size_t side : {0, 1}) {
      GripControl& drive = progress_.drives[side];
      if (phase.kind == PhaseKind::approach) {
        drive.go_to(start_gap_m_ - phase.gap_m);
      } else if (phase.kind == PhaseKind::close && phase.width_m) {
        drive.go_to(from[side].closed_m + part * (0.5 * (start_width_m_ - *phase.width_m) - mean_m));
      } else if (phase.kind == PhaseKind::close) {
        drive.grip(from[side].wanted_n + part * (phase.force_n - from[side].wanted_n));
      }
    }
  }

  void run_phase(const GraspPhase& phase, int index) {
    const double h = config_.time_step_s;
    const int steps = phase.steps * phase.substeps;
    const bool closes = phase.kind == PhaseKind::close, goes_on = closes || phase.kind == PhaseKind::approach;
    const std::array<GripControl, 2> from = progress_.drives;
    for (int f = 1; f <= phase.steps; ++f) {
      const bool last = f == phase.steps;
      if (restored()) continue;
      StepReport report;
      try {
        for (int k = 0; k < phase.substeps; ++k) {
          const int i = (f - 1) * phase.substeps + k;
          set_goal(phase, (i + 1.0) / steps, from);
          enough_n_ = closes && !phase.width_m && i + 1 < steps ? phase.force_n : 0.0;
          time_step(phase, h, hand_in(phase, (i + 1.0) / steps, (i + 1) * h) - hand_in(phase, 1.0 * i / steps, i * h),
                    report);
        }
        enough_n_ = 0.0;
        // The object does not wait: it is held until the fingers have their grip.
        for (int more = 0; goes_on && last && !lost() && !arrived(); ++more) {
          if (more == kMostClosingSteps) throw_not_closed();
          time_step(phase, h, {}, report);
        }
      } catch (const SolverError& error) {
        throw SolverError("frame {}: {}", out_.frames.size(), error.what());
      }
      if (closes && last && !is_free()) let_go();
      finish(phase.kind, index, report, stepper_->forces());
    }
  }

  [[noreturn]] void throw_not_closed() const {
    const GripControl& drive = progress_.drives[progress_.drives[0].arrived(spec_.mount) ? 1 : 0];
    if (drive.by_way)
      throw SolverError(
          "in {} more time steps each finger has closed by {:.3g} mm instead of {:.3g} mm: give the phase more steps, "
          "or the fingers a larger closing_speed_mm_s",
          kMostClosingSteps, 1e3 * drive.closed_m, 1e3 * drive.wanted_closed_m);
    throw SolverError(
        "the fingers reached {:.3g} N instead of {:.3g} N in {} more time steps, each closed by {:.3g} mm: is "
        "anything between them at fingers.grip_mm? A small closing_speed_mm_s, or a force_n that is too "
        "much for the gel, can be why, too",
        drive.last_grip_n, drive.wanted_n, kMostClosingSteps, 1e3 * drive.closed_m);
  }

  void let_go() {
    for (GripControl& drive : progress_.drives) drive.let_go = true;
    progress_.grip_n = grip_n();
    const auto poses = finger_poses();
    const double left = pressing_n(force_on(0), poses[0]), right = pressing_n(force_on(1), poses[1]);
    if (std::abs(left - right) > kUneven * (left + right))
      log_warning(
          "frame {}: when the object was freed the left finger pressed with {:.3g} N and the right one with {:.3g} N: "
          "it will shift towards the weaker; choose fingers.grip_mm or turn_deg so that both press alike, or "
          "fingers.drive: each",
          out_.frames.size(), left, right);
  }

  void time_step(const GraspPhase& phase, double h, const RigidWay& hand, StepReport& report) {
    time_s_ += h;
    if (phase.kind == PhaseKind::release) {
      Ways opening;
      opening.fill(-phase.distance_m / (phase.steps * phase.substeps));
      step(h, opening, hand, 0, report);
      measure(h, opening);
      // What is left of it is kept from there on.
      for (GripControl& drive : progress_.drives) {
        drive.wanted_n = drive.last_grip_n;
        drive.wanted_closed_m = drive.closed_m;
      }
    } else if (lost() || progress_.drives[0].by_way) {
      const double most = spec_.closing_speed_m_s * h;
      Ways ways{0.0, 0.0};
      for (const std::size_t side : {0, 1}) {
        const GripControl& drive = progress_.drives[side];
        if (!lost()) ways[side] = std::clamp(drive.wanted_closed_m - drive.closed_m, -most, most);
      }
      step(h, ways, hand, 0, report);
      measure(h, ways);
    } else {
      balanced_step(h, hand, report);
    }
  }

  void measure(double h, const Ways& ways) {
    const Ways grips = grips_n();
    for (const std::size_t side : {0, 1}) progress_.drives[side].measure(h, ways[side], grips[side]);
  }

  /// How much farther than a motion of the hand the object's centre of mass goes along the closing axis, from one pose
  /// to another.
  double along_axis(const Matrix4& from, const Matrix4& to, const Matrix4& motion, const Matrix4& hand) const {
    const Eigen::Vector4d center = out_.center_of_mass_m.homogeneous();
    const Vector3 axis = (motion * hand).col(0).head<3>();
    return axis.dot((to * center - motion * (from * center)).head<3>());
  }

  /// By how much more than in the last try a free object between two drives will go from left to right when both are
  /// corrected: the solution of their three linear equations.
  /// \param pull_n what its own balance is off by
  static double shift_of_object(const std::array<WaySearch, 2>& search, double object_n_m, double pull_n) {
    double force = pull_n, stiffness = object_n_m;
    for (const std::size_t side : {0, 1}) {
      const double own = search[side].stiffness_n_m(), all = own + search[side].inertia_n_m();
      if (own == 0.0) continue;
      force -= (side == 0 ? 1.0 : -1.0) * own * search[side].off_n() / all;
      stiffness += own * search[side].inertia_n_m() / all;
    }
    return force / stiffness;
  }

  /// A time step that ends with each drive in balance: tried with several ways, each from where it begins.
  void balanced_step(double h, const RigidWay& hand, StepReport& report) {
    const GraspProgress before = progress_;
    const WholeAccount whole_before = whole_;
    const Matrix4 object_before = world_from_object_, motion = motion_of_world(progress_.world_from_hand, hand);
    const auto begin = [&](std::size_t side) {
      return WaySearch(before.drives[side], spec_.mount, h, spec_.closing_speed_m_s * h, scales_.d_hat_m,
                       [&](double none) { return stepper_->smallest_gap(progress_.state.x, none); });
    };
    const WaySearch left = begin(0);
    std::array<WaySearch, 2> search{left, spec_.drive_each ? begin(1) : left};
    // A held object leaves each drive alone.
    const bool coupled = spec_.drive_each && is_free();
    const double object_n_m = body_->mass_kg / (h * h);
    const auto object_way = [&](const Matrix4& to) {
      return along_axis(object_before, to, motion, before.world_from_hand);
    };
    if (coupled) {
      Matrix4 flown = object_before;
      flown.topRightCorner<3, 1>() += h * before.state.object_motion[0].velocity_m_s + h * h * spec_.gravity_m_s2;
      const double pressed_n = before.drives[0].last_grip_n - before.drives[1].last_grip_n;
      const double shift_m = shift_of_object(search, object_n_m, object_n_m * object_way(flown) + pressed_n);
      search[0].expect(shift_m);
      search[1].expect(-shift_m);
    }
    const auto start_again = [&] {
      progress_ = before;
      whole_ = whole_before;
      world_from_object_ = object_before;
    };
    StepReport spent;
    std::optional<Ways> solved;
    bool gives_up = false;
    while (true) {
      const Ways ways = gives_up ? *solved : Ways{search[0].way_m(), search[1].way_m()};
      StepReport done;
      try {
        step(h, ways, hand, 0, done);
      } catch (const SolverError& error) {
        // Better off balance than not at all.
        if (!solved || gives_up) throw;
        log_info("frame {}: {}; the fingers go by a way that could be solved", out_.frames.size(), error.what());
        gives_up = true;
        start_again();
        continue;
      }
      solved = ways;
      const Ways grips = grips_n();
      if (!gives_up) {
        const double object_m = coupled ? object_way(world_from_object_) : 0.0;
        search[0].note(grips[0], object_m);
        search[1].note(grips[1], -object_m);
      }
      // On the way to a grip, with the object still held, nothing hangs on how fast that grows.
      const bool enough = !is_free() && spec_.mount.none() && std::max(grips[0], grips[1]) <= enough_n_;
      if (gives_up || enough || (search[0].stands() && search[1].stands())) {
        done.add_earlier(spent);
        done.add_earlier(report);
        report = done;
        for (const std::size_t side : {0, 1})
          progress_.drives[side].measure(h, ways[side], grips[side], search[side].found_n_m());
        return;
      }
      done.time_steps = 0;  // it is the same step
      done.add_earlier(spent);
      spent = done;
      start_again();
      const double shift_m = coupled ? shift_of_object(search, object_n_m, 0.0) : 0.0;
      search[0].correct(shift_m);
      search[1].correct(-shift_m);
    }
  }

  bool restored() {
    if (!store_ || !restoring_) return false;
    const std::optional<std::string> bytes = store_->load();
    restoring_ = bytes.has_value();
    if (!restoring_) return false;
    GraspFrame frame;
    std::array<Frame, 2> of_fingers;
    unpack_frame(*bytes, frame, of_fingers, progress_);
    for (const std::size_t side : {0, 1}) out_.fingers[side].frames.push_back(std::move(of_fingers[side]));
    time_s_ = frame.time_s;
    whole_ = frame.whole;
    whole_.momentum_residual_n = whole_.angular_residual_n_m = 0.0;
    world_from_object_ = frame.world_from_object;
    log_info("frame {}/{} resumed from an interrupted run", out_.frames.size(), num_frames_);
    out_.frames.push_back(frame);
    note_grip();
    return true;
  }

  void save(const std::array<Frame, 2>& of_fingers) {
    if (store_) store_->save(pack_frame(out_.frames.back(), of_fingers, progress_));
  }

  FingerDrive drive_of(std::size_t side) const {
    const GripControl& drive = progress_.drives[side];
    return {drive.wanted_n, drive.closed_m, drive.velocity_m_s};
  }

  Vector3 spin() const {
    return angular_velocity(*body_, mesh_.control_rows(progress_.state.x), progress_.state.object_motion[0]);
  }

  void finish(PhaseKind phase, int phase_index, const StepReport& report, const StepForces& forces) {
    const Positions& x = progress_.state.x;
    GraspFrame frame{.time_s = time_s_,
                     .phase = phase,
                     .world_from_hand = progress_.world_from_hand,
                     .world_from_finger = finger_poses(),
                     .drives = {drive_of(0), drive_of(1)},
                     .world_from_object = world_from_object_,
                     .velocity_m_s = progress_.state.object_motion[0].velocity_m_s,
                     .spin_rad_s = spin(),
                     .body_residual_n = report.body_residual_n,
                     .body_load_n = report.body_load_n,
                     .whole = whole_};
    whole_.momentum_residual_n = whole_.angular_residual_n_m = 0.0;
    const Positions object_at = mesh_.object_rows(x), gels_at = x.topRows(both_.num_vertices());
    const IntersectionReport crossings = find_intersections({gels_at, both_.boundary}, {object_at, object_.triangles});
    const double gap = stepper_->smallest_gap(x, scales_.gap_horizon_m);
    std::array<Frame, 2> of_fingers;
    for (const std::size_t side : {0, 1}) {
      const SolvedGel finger = part(side);
      const Matrix4& world_from_finger = frame.world_from_finger[side];
      Frame& own = of_fingers[side];
      own = gel_frame(finger, world_from_finger,
                      phase_index < 0 ? gel_.positions : positions_in_gel(finger, world_from_finger, x), forces);
      own.time_s = time_s_;
      own.phase = phase;
      own.phase_index = phase_index;
      own.solver = report;
      add_object(own, world_from_finger, world_from_object_, frame.velocity_m_s, frame.spin_rad_s);
      own.min_gap_m = gap;
      own.intersections = static_cast<int>(crossings.gel_object + crossings.gel_gel);
      own.gel_in_object =
          winding_number(gels_at.row(finger.first_row + finger.front.vertices[0]), {object_at, object_.triangles});
      own.body_strain = strain_of(*body_, mesh_.control_rows(x));
      frame.force_on_finger_n[side] = phase_index < 0 ? Vector3::Zero() : force_on(side);
      judge_frame(static_cast<int>(out_.frames.size()), numbers_of(own),
                  limits_of(config_, settings_.newton, report.contact_force_n));
      out_.fingers[side].frames.push_back(own);
    }
    if (grip_frame_) {
      const InHand since = motion_in_hand(out_.frames[*grip_frame_], frame, out_.grip_point());
      frame.slip_m = since.slip_m;
      frame.turn_rad = since.turn_rad;
    }
    log_info(
        "frame {}/{} {}: grip {:.3f} N, carried {:.4f} N, slipped {:.3f} mm, turned {:.2f} deg, {} Newton iterations "
        "in {} steps, smallest gap {:.3g} um",
        out_.frames.size(), num_frames_, name_of(phase), phase_index < 0 ? 0.0 : grip_n(),
        -(frame.force_on_finger_n[0] + frame.force_on_finger_n[1]).z(), 1e3 * frame.slip_m,
        frame.turn_rad * 180.0 / std::numbers::pi, report.newton_iterations, report.time_steps, 1e6 * gap);
    out_.frames.push_back(frame);
    note_grip();
    save(of_fingers);
  }

  void note_grip() {
    if (!grip_frame_ && is_free()) grip_frame_ = out_.frames.size() - 1;
  }

  void judge_outcome() {
    // Fingers that open lose the object in any case.
    const auto released = std::find_if(out_.frames.begin(), out_.frames.end(),
                                       [](const GraspFrame& frame) { return frame.phase == PhaseKind::release; });
    out_.judged_frame = static_cast<std::size_t>(released - out_.frames.begin()) - 1;
    out_.outcome = outcome_of(out_.frames[*grip_frame_], out_.frames[out_.judged_frame], out_.grip_point());
    add_labels(out_);
  }

  const Sensor& sensor_;
  const TetMesh& gel_;
  const TriangleMesh& object_;
  const PressConfig config_;
  const GraspSpec& spec_;
  const ProgressObserver& observe_;
  ByteStore* store_;
  const Scales scales_;
  StepSettings settings_;
  const double start_gap_m_;
  const std::vector<RestTet> rest_tets_;
  Grasp out_;
  std::optional<AffineBody> body_;
  std::array<Matrix4, 2> start_;
  double start_width_m_ = 0.0;  // between the origins of both S
  TetMesh both_;
  ContactMesh mesh_;
  std::vector<int> glued_;
  GelModel model_;
  TimeStepper* stepper_ = nullptr;
  GraspProgress progress_;
  WholeAccount whole_;
  Matrix4 world_from_object_;
  double time_s_ = 0.0;
  int num_frames_ = 0;
  double enough_n_ = 0.0;  // while the fingers close on a held object, a grip up to this needs no second try
  std::optional<std::size_t> grip_frame_;
  bool restoring_ = true;
};

}  // namespace

double GraspFrame::grip_n(std::size_t side) const {
  return pressing_n(force_on_finger_n[side], world_from_finger[side]);
}

Grasp grasp(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
            const GraspSpec& spec, const ProgressObserver& observe, ByteStore* store) {
  return Hand(sensor, gel, object, config, spec, observe, store).run();
}

}  // namespace tacipc
