#include "stages/gel/press/grasp.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/mesh/mass_properties.h"
#include "common/sample/placement.h"
#include "stages/gel/press/checkpoint.h"
#include "stages/gel/press/energy/elasticity.h"
#include "stages/gel/press/setup.h"

namespace tacipc {
namespace {

constexpr double kFirstTouch_m = 2e-5;  // a finger that touches for the first time closes by this in the next step
// A measured stiffness counts as at least the first times the last one, and at most the second where the step was
// shorter than the first touch: it measures what else has changed the grip, too.
constexpr double kSofterMost = 0.5, kStifferMost = 4.0;
// Fingers that touch go at most so many times as far as in their last step: a gel that is touched by little more at
// first tells nothing of how stiff it will be.
constexpr double kGrowth = 2.0;
constexpr double kMeasurable_m = 1e-6;   // a shorter step measures no stiffness
constexpr double kGripTolerance = 0.02;  // of the force asked for, when fingers count as closed
constexpr int kMostClosingSteps = 200;   // after the frames of a phase `close`
constexpr double kTouches_n = 1e-6;
constexpr double kUneven = 0.1;  // of both grips together, by which one may exceed the other without a warning
// Outcome: a held object has slipped or turned from here on; one that rose by less than a part of the hand's way is
// dropped.
constexpr double kSlipped_m = 1e-3, kTurned_rad = 5.0 * std::numbers::pi / 180.0, kDroppedPart = 0.2;

/// z of S is x of the world for the left finger and −x for the right one; the images' down, y, is the world's.
Matrix3 world_from_finger(int side) {
  const Vector3 z = side == 0 ? Vector3::UnitX() : Vector3(-Vector3::UnitX()), y = -Vector3::UnitZ();
  Matrix3 R;
  R << y.cross(z), y, z;
  return R;
}

Positions rotated(const Positions& rows, const Matrix3& rotation) { return rows * rotation.transpose(); }

TetMesh joined(const TetMesh& gel, const std::array<Matrix4, 2>& poses) {
  const auto n = static_cast<int>(gel.num_vertices());
  TetMesh both;
  both.positions.resize(2 * n, 3);
  both.positions << transformed(poses[0], gel.positions), transformed(poses[1], gel.positions);
  both.tets.resize(2 * gel.tets.rows(), 4);
  both.tets << gel.tets, gel.tets.array() + n;
  both.boundary.resize(2 * gel.boundary.rows(), 3);
  both.boundary << gel.boundary, gel.boundary.array() + n;
  both.tags = gel.tags;
  both.tags.insert(both.tags.end(), gel.tags.begin(), gel.tags.end());
  return both;
}

/// How the fingers are driven from one time step to the next.
struct Drive {
  double wanted_n = 0.0;  // grip that the last time step should have ended with
  double closed_m = 0.0;  // of each finger, from where it began
  double last_step_m = 0.0, last_grip_n = 0.0;
  double stiffness_n_m = 0.0;  // of the grip, as the last steps had it
  Vector3 hand_m = Vector3::Zero();
  bool let_go = false;  // the object is free
};

/// Hands every number of a frame and of the drive to `io`, one by one: as a whole they have bytes between them that
/// mean nothing and differ from run to run.
void contents(auto& io, auto& frame, auto& drive) {
  const auto each = [&](auto& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) io(matrix.data()[i]);
  };
  io(frame.time_s);
  io(frame.phase);
  for (auto& pose : frame.world_from_finger) each(pose);
  for (auto& force : frame.force_on_finger_n) each(force);
  each(frame.world_from_object);
  each(frame.velocity_m_s);
  each(frame.spin_rad_s);
  io(frame.body_residual_n);
  io(frame.body_load_n);
  io(frame.slip_m);
  io(frame.turn_rad);
  io(drive.wanted_n);
  io(drive.closed_m);
  io(drive.last_step_m);
  io(drive.last_grip_n);
  io(drive.stiffness_n_m);
  each(drive.hand_m);
  io(drive.let_go);
}

class Hand {
 public:
  Hand(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
       const GraspSpec& spec, const ProgressObserver& observe, ByteStore* store)
      : sensor_(sensor),
        gel_(gel),
        object_(object),
        config_(config),
        spec_(spec),
        observe_(observe),
        store_(store),
        scales_(scales_of(config, sensor, gel)),
        settings_(step_settings(config, scales_)),
        rest_tets_(make_rest_tets(gel.positions, gel.tets)) {
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
    TimeStepper stepper(mesh_, make_gel_model(sensor_.material, both_, rest_both_, element), settings_, body_);
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
    progress_.state.x.resize(mesh_.num_rows(), 3);
    progress_.state.x << mesh_.rest_positions, control_at(world_from_object_);
    progress_.state.velocity_m_s = Positions::Zero(both_.num_vertices(), 3);
    if (stepper.smallest_gap(progress_.state.x, scales_.gap_horizon_m) <= scales_.d_hat_m)
      throw DataError("the object is nearer to a finger than d_hat = {:.3g} m in frame 0", scales_.d_hat_m);
    if (!restored()) finish(PhaseKind::reference, -1, {}, stepper.no_forces());
    for (std::size_t p = 0; p < spec_.motion.size(); ++p) run_phase(spec_.motion[p], static_cast<int>(p));
    for (Simulation& finger : out_.fingers) finger.times = stepper.times();
    judge_outcome();
    return std::move(out_);
  }

 private:
  /// Turns the object, hangs its grip point at the origin and puts the fingers beside it.
  void place_all() {
    const MassProperties mass = mass_properties(object_.positions, object_.triangles);
    const double friction = config_.friction ? config_.friction->coefficient : 0.0;
    body_ = make_affine_body(object_.positions, object_.triangles, spec_.density_of(mass.volume_m3, friction));
    out_.mass_kg = body_->mass_kg;
    out_.weight_n = body_->mass_kg * spec_.gravity_m_s2.norm();
    out_.center_of_mass_m = mass.center_m;
    out_.pose = spec_.pose_of(object_, mass, sensor_.gel, friction);
    const Matrix3& turn = out_.pose.world_from_object;
    world_from_object_.setIdentity();
    world_from_object_.topLeftCorner<3, 3>() = turn;
    world_from_object_.topRightCorner<3, 1>() = -turn * (mass.center_m + out_.pose.grip_m);
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
      start_[side].topRightCorner<3, 1>() = -R.col(2) * (reach + scales_.start_gap_m);
    }
    both_ = joined(gel_, start_);
    rest_both_ = make_rest_tets(both_.positions, both_.tets);
    mesh_ = make_contact_mesh(both_.positions, both_.boundary, at, object_.triangles);
    mesh_.num_control_points = 4;
    const int anchor = gel_.vertices(BoundaryTag::glued).front();
    const auto alone = std::make_shared<const ContactMesh>(
        make_contact_mesh(gel_.positions, gel_.boundary, Positions(0, 3), Triangles(0, 3)));
    for (int side = 0; side < 2; ++side) {
      mesh_.gels.push_back({side * static_cast<int>(gel_.num_vertices()), anchor, alone});
      turns_.push_back(start_[side].topLeftCorner<3, 3>());
    }
    glued_ = both_.vertices(BoundaryTag::glued);
  }

  ControlPoints control_at(const Matrix4& pose) const { return transformed(pose, body_->rest_m); }

  std::array<Matrix4, 2> finger_poses(const Drive& drive) const {
    std::array<Matrix4, 2> poses = start_;
    for (Matrix4& pose : poses)
      pose.topRightCorner<3, 1>() += drive.hand_m + drive.closed_m * pose.topLeftCorner<3, 3>().col(2);
    return poses;
  }

  double grip_n() const {
    double sum = 0.0;
    for (int side = 0; side < 2; ++side) sum += std::abs(force_on(side).x());
    return 0.5 * sum;
  }

  Vector3 force_on(int side) const {
    const StepForces& forces = stepper_->forces();
    const Eigen::Index n = gel_.num_vertices();
    if (forces.normal.rows() == 0) return Vector3::Zero();
    return (forces.normal.middleRows(side * n, n) + forces.friction.middleRows(side * n, n)).colwise().sum();
  }

  /// How far both fingers close in a time step of h that should end with the grip that is wanted.
  double closing_step(double h) const {
    const double most = spec_.closing_speed_m_s * h, grip = drive_.last_grip_n;
    if (grip < kTouches_n) {
      // Up to the object, and then little by little: how stiff it is is not known yet.
      const double gap = stepper_->smallest_gap(progress_.state.x, most + scales_.d_hat_m);
      return std::clamp(gap - scales_.d_hat_m, std::min(kFirstTouch_m, most), most);
    }
    const double bound = std::min(most, kGrowth * std::max(std::abs(drive_.last_step_m), kFirstTouch_m));
    return std::clamp((drive_.wanted_n - grip) / drive_.stiffness_n_m, -bound, bound);
  }

  void measure_grip(double step_m) {
    const double grip = grip_n(), touched = grip - drive_.last_grip_n;
    double& stiffness = drive_.stiffness_n_m;
    if (stiffness == 0.0) {
      // The first touch: what it took, from somewhere within the step.
      if (grip > kTouches_n) stiffness = grip / std::max(std::abs(step_m), kFirstTouch_m);
    } else if (std::abs(step_m) > kMeasurable_m && touched / step_m > 0.0) {
      double now = std::max(touched / step_m, kSofterMost * stiffness);
      if (std::abs(step_m) < kFirstTouch_m) now = std::min(now, kStifferMost * stiffness);
      stiffness = now;
    }
    drive_.last_step_m = step_m;
    drive_.last_grip_n = grip;
  }

  /// One time step, in which the hand moves and the fingers close; divided where it does not converge.
  void step(double h, double closing_m, const Vector3& hand_m, int halvings, StepReport& report) {
    Drive after = drive_;
    after.closed_m += closing_m;
    after.hand_m += hand_m;
    const std::array<Matrix4, 2> before = finger_poses(drive_), poses = finger_poses(after);
    const auto n = static_cast<int>(gel_.num_vertices());
    Positions target(2 * n, 3), start(2 * n, 3);
    target << transformed(poses[0], gel_.positions), transformed(poses[1], gel_.positions);
    start << transformed(before[0], gel_.positions), transformed(before[1], gel_.positions);
    StepGoal goal{.h_s = h,
                  .object_target = transformed(world_from_object_, object_.positions),
                  .free_object = drive_.let_go,
                  .gel_motion = target - start,
                  .glued_target = target(glued_, Eigen::all),
                  .hand_shift_m = hand_m,
                  .world_from_gel = turns_,
                  .control_target = control_at(world_from_object_)};
    if (goal.gel_motion.isZero(0.0)) goal.gel_motion.resize(0, 3);
    try {
      const StepReport done = stepper_->advance(progress_.state, goal, [&](int iteration, double residual) {
        observe_(static_cast<int>(out_.frames.size()), num_frames_, iteration, residual);
      });
      drive_ = after;
      if (drive_.let_go) world_from_object_ = pose_of(*body_, mesh_.control_rows(progress_.state.x));
      const StepReport earlier = report;
      report = done;
      report.add_earlier(earlier);
    } catch (const SolverError& error) {
      if (halvings >= config_.max_halvings) throw;
      log_info("frame {}: {}; dividing the time step", out_.frames.size(), error.what());
      step(0.5 * h, 0.5 * closing_m, 0.5 * hand_m, halvings + 1, report);
      step(0.5 * h, 0.5 * closing_m, 0.5 * hand_m, halvings + 1, report);
    }
  }

  /// Where the hand is after a part of a phase, from where that began.
  static Vector3 hand_in(const GraspPhase& phase, double part, double seconds) {
    Vector3 at = Vector3::Zero();
    if (phase.kind == PhaseKind::lift) at.z() = phase.distance_m * part * part * (3.0 - 2.0 * part);
    if (phase.kind == PhaseKind::shake)
      at[phase.axis] =
          0.5 * phase.amplitude_m * (1.0 - std::cos(2.0 * std::numbers::pi * phase.frequency_hz * seconds));
    return at;
  }

  void run_phase(const GraspPhase& phase, int index) {
    const double h = config_.time_step_s;
    const int steps = phase.steps * phase.substeps;
    const bool closes = phase.kind == PhaseKind::close;
    const double from_n = drive_.wanted_n;
    for (int f = 1; f <= phase.steps; ++f) {
      const bool last = f == phase.steps;
      if (restored()) continue;
      StepReport report;
      try {
        for (int k = 0; k < phase.substeps; ++k) {
          const int i = (f - 1) * phase.substeps + k;
          if (closes) drive_.wanted_n = from_n + (i + 1.0) * (phase.force_n - from_n) / steps;
          const Vector3 hand = hand_in(phase, (i + 1.0) / steps, (i + 1) * h) - hand_in(phase, 1.0 * i / steps, i * h);
          drive(phase, h, hand, report);
        }
        // The object does not wait: it is held until the fingers have their grip.
        for (int more = 0; closes && last && !lost() && !gripped(phase.force_n); ++more) {
          if (more == kMostClosingSteps)
            throw SolverError(
                "the fingers reached {:.3g} N instead of {:.3g} N in {} more time steps, each closed by {:.3g} mm: is "
                "anything between them at fingers.grip_mm? A small closing_speed_mm_s, or a force_n that is too "
                "much for the gel, can be why, too",
                drive_.last_grip_n, phase.force_n, kMostClosingSteps, 1e3 * drive_.closed_m);
          drive(phase, h, Vector3::Zero(), report);
        }
      } catch (const SolverError& error) {
        throw SolverError("frame {}: {}", out_.frames.size(), error.what());
      }
      if (closes && last && !drive_.let_go) let_go();
      finish(phase.kind, index, report, stepper_->forces());
    }
  }

  void let_go() {
    drive_.let_go = true;
    out_.grip_n = drive_.last_grip_n;
    const double left = std::abs(force_on(0).x()), right = std::abs(force_on(1).x());
    if (std::abs(left - right) > kUneven * (left + right))
      log_warning(
          "frame {}: when the object was freed the left finger pressed with {:.3g} N and the right one with {:.3g} N: "
          "it will shift towards the weaker; choose fingers.grip_mm or turn_deg so that both press alike",
          out_.frames.size(), left, right);
  }

  /// Whether the object is free and neither finger touches it: fingers neither close nor open any further then, except
  /// in a release.
  bool lost() const { return drive_.let_go && drive_.last_grip_n < kTouches_n; }
  bool gripped(double force_n) const { return std::abs(drive_.last_grip_n - force_n) <= kGripTolerance * force_n; }

  void drive(const GraspPhase& phase, double h, const Vector3& hand, StepReport& report) {
    double closing = 0.0;
    if (phase.kind == PhaseKind::release) {
      closing = -phase.distance_m / (phase.steps * phase.substeps);
    } else if (!lost()) {
      closing = closing_step(h);
    }
    time_s_ += h;
    step(h, closing, hand, 0, report);
    measure_grip(closing);
    // What is left of it is kept from there on.
    if (phase.kind == PhaseKind::release) drive_.wanted_n = drive_.last_grip_n;
  }

  bool restored() {
    if (!store_ || !restoring_) return false;
    const std::optional<std::string> bytes = store_->load();
    restoring_ = bytes.has_value();
    if (!restoring_) return false;
    std::string_view rest = *bytes;
    const auto take = [&](auto& value) {
      if (rest.size() < sizeof(value)) throw DataError("a saved frame ends too early");
      std::memcpy(&value, rest.data(), sizeof(value));
      rest.remove_prefix(sizeof(value));
    };
    GraspFrame frame;
    contents(take, frame, drive_);
    take(out_.grip_n);
    std::array<std::size_t, 2> sizes{};
    take(sizes);
    if (sizes[0] > rest.size() || sizes[1] != rest.size() - sizes[0])
      throw DataError("a saved frame has another length than it says");
    Progress unused;
    for (int side = 0; side < 2; ++side) {
      Frame of_finger;
      unpack_frame(rest.substr(side == 0 ? 0 : sizes[0], sizes[static_cast<std::size_t>(side)]), of_finger,
                   side == 0 ? progress_ : unused);
      out_.fingers[static_cast<std::size_t>(side)].frames.push_back(std::move(of_finger));
    }
    time_s_ = frame.time_s;
    world_from_object_ = frame.world_from_object;
    log_info("frame {}/{} resumed from an interrupted run", out_.frames.size(), num_frames_);
    out_.frames.push_back(frame);
    note_grip();
    return true;
  }

  void save() {
    if (!store_) return;
    const std::string left = pack_frame(out_.fingers[0].frames.back(), progress_),
                      right = pack_frame(out_.fingers[1].frames.back(), {});
    std::string bytes;
    const auto put = [&](const auto& value) {
      static_assert(std::is_arithmetic_v<std::decay_t<decltype(value)>> ||
                    std::is_enum_v<std::decay_t<decltype(value)>> ||
                    std::is_same_v<std::decay_t<decltype(value)>, std::array<std::size_t, 2>>);
      bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
    };
    contents(put, out_.frames.back(), drive_);
    put(out_.grip_n);
    put(std::array<std::size_t, 2>{left.size(), right.size()});
    store_->save(bytes + left + right);
  }

  /// One finger's part of a frame, in its own frame S.
  Frame finger_frame(int side, const Matrix4& world_from_finger, PhaseKind phase, int phase_index,
                     const StepReport& report, const StepForces& forces) const {
    const Eigen::Index n = gel_.num_vertices();
    const Matrix3 to_finger = world_from_finger.topLeftCorner<3, 3>().transpose();
    const auto own = [&](const Positions& rows) { return rotated(rows.middleRows(side * n, n), to_finger); };
    const Simulation& finger = out_.fingers[static_cast<std::size_t>(side)];
    Frame frame;
    frame.time_s = time_s_;
    frame.phase = phase;
    frame.phase_index = phase_index;
    const Vector3 origin = world_from_finger.topRightCorner<3, 1>();
    frame.positions =
        phase_index < 0 ? gel_.positions
                        : rotated(progress_.state.x.middleRows(side * n, n).rowwise() - origin.transpose(), to_finger);
    frame.gel_from_object = world_from_finger.inverse() * world_from_object_;
    const Positions normal = own(forces.normal), friction = own(forces.friction), contact = normal + friction;
    frame.normal_force_n = on_front(finger.front, normal);
    frame.friction_force_n = on_front(finger.front, friction);
    for (const int v : finger.front.vertices)
      frame.contact_state.push_back(forces.contact_state[static_cast<std::size_t>(side * n + v)]);
    for (Eigen::Index v = 0; v < n; ++v) {
      const Vector3 force = contact.row(v), arm = frame.positions.row(v);
      frame.force_n += force;
      frame.torque_n_m += arm.cross(force);
    }
    frame.balance =
        balance_of(frame.positions, {.contact = contact, .inertia = own(forces.body), .mount = own(forces.mount)});
    frame.stand_off_m = forces.stand_off_m;
    frame.min_volume_ratio = min_volume_ratio(frame.positions, gel_.tets, rest_tets_);
    frame.inverted_tets = static_cast<int>(count_inverted_tets(frame.positions, gel_.tets));
    frame.solver = report;
    frame.object_velocity_m_s = to_finger * progress_.state.object_motion.velocity_m_s;
    frame.object_spin_rad_s = to_finger * spin();
    return frame;
  }

  Vector3 spin() const {
    return angular_velocity(*body_, mesh_.control_rows(progress_.state.x), progress_.state.object_motion);
  }

  void finish(PhaseKind phase, int phase_index, const StepReport& report, const StepForces& forces) {
    const Positions& x = progress_.state.x;
    GraspFrame frame{.time_s = time_s_,
                     .phase = phase,
                     .world_from_finger = finger_poses(drive_),
                     .world_from_object = world_from_object_,
                     .velocity_m_s = progress_.state.object_motion.velocity_m_s,
                     .spin_rad_s = spin(),
                     .body_residual_n = report.body_residual_n,
                     .body_load_n = report.body_load_n};
    const Positions object_at = mesh_.object_rows(x), gels_at = x.topRows(both_.num_vertices());
    const IntersectionReport crossings = find_intersections({gels_at, both_.boundary}, {object_at, object_.triangles});
    const double gap = stepper_->smallest_gap(x, scales_.gap_horizon_m);
    for (int side = 0; side < 2; ++side) {
      Frame own = finger_frame(side, frame.world_from_finger[static_cast<std::size_t>(side)], phase, phase_index,
                               report, forces);
      own.min_gap_m = gap;
      own.intersections = static_cast<int>(crossings.gel_object + crossings.gel_gel);
      own.gel_in_object = winding_number(gels_at.row(side * gel_.num_vertices() + out_.fingers[0].front.vertices[0]),
                                         {object_at, object_.triangles});
      own.body_strain = strain_of(*body_, mesh_.control_rows(x));
      frame.force_on_finger_n[static_cast<std::size_t>(side)] = phase_index < 0 ? Vector3::Zero() : force_on(side);
      judge_frame(static_cast<int>(out_.frames.size()), numbers_of(own),
                  limits_of(config_, settings_.newton, report.contact_force_n));
      out_.fingers[static_cast<std::size_t>(side)].frames.push_back(std::move(own));
    }
    if (grip_frame_) {
      const GraspFrame& then = out_.frames[*grip_frame_];
      frame.slip_m = (grip_point(frame) - hand(frame) - grip_point(then) + hand(then)).norm();
      frame.turn_rad = Eigen::AngleAxisd(Matrix3(frame.world_from_object.topLeftCorner<3, 3>() *
                                                 then.world_from_object.topLeftCorner<3, 3>().transpose()))
                           .angle();
    }
    log_info(
        "frame {}/{} {}: grip {:.3f} N, carried {:.4f} N, slipped {:.3f} mm, turned {:.2f} deg, {} Newton iterations "
        "in {} steps, smallest gap {:.3g} um",
        out_.frames.size(), num_frames_, name_of(phase), phase_index < 0 ? 0.0 : grip_n(),
        -(frame.force_on_finger_n[0] + frame.force_on_finger_n[1]).z(), 1e3 * frame.slip_m,
        frame.turn_rad * 180.0 / std::numbers::pi, report.newton_iterations, report.time_steps, 1e6 * gap);
    out_.frames.push_back(frame);
    note_grip();
    save();
  }

  void note_grip() {
    if (!grip_frame_ && drive_.let_go) grip_frame_ = out_.frames.size() - 1;
  }

  /// The middle between the fingers.
  static Vector3 hand(const GraspFrame& frame) {
    return 0.5 * (frame.world_from_finger[0] + frame.world_from_finger[1]).topRightCorner<3, 1>();
  }

  /// The object's point at the grip, in the world.
  Vector3 grip_point(const GraspFrame& frame) const {
    const Vector3 grip = out_.center_of_mass_m + out_.pose.grip_m;
    return frame.world_from_object.topLeftCorner<3, 3>() * grip + frame.world_from_object.topRightCorner<3, 1>();
  }

  void judge_outcome() {
    // Fingers that open lose the object in any case.
    const auto released = std::find_if(out_.frames.begin(), out_.frames.end(),
                                       [](const GraspFrame& frame) { return frame.phase == PhaseKind::release; });
    out_.judged_frame = static_cast<std::size_t>(released - out_.frames.begin()) - 1;
    const GraspFrame &end = out_.frames[out_.judged_frame], &begin = out_.frames[*grip_frame_];
    const bool touches = end.force_on_finger_n[0].norm() > kTouches_n && end.force_on_finger_n[1].norm() > kTouches_n;
    const double hand = (end.world_from_finger[0] - begin.world_from_finger[0])(2, 3);
    const double rose = (grip_point(end) - grip_point(begin)).z();
    out_.outcome = !touches || (hand >= kSlipped_m && rose < kDroppedPart * hand) ? GraspOutcome::dropped
                   : end.slip_m >= kSlipped_m                                     ? GraspOutcome::slipped
                   : end.turn_rad >= kTurned_rad                                  ? GraspOutcome::rotated
                                                                                  : GraspOutcome::lifted;
  }

  const Sensor& sensor_;
  const TetMesh& gel_;
  const TriangleMesh& object_;
  const PressConfig& config_;
  const GraspSpec& spec_;
  const ProgressObserver& observe_;
  ByteStore* store_;
  const Scales scales_;
  StepSettings settings_;
  const std::vector<RestTet> rest_tets_;
  Grasp out_;
  std::optional<AffineBody> body_;
  std::array<Matrix4, 2> start_;
  std::vector<Matrix3> turns_;
  TetMesh both_;
  std::vector<RestTet> rest_both_;
  ContactMesh mesh_;
  std::vector<int> glued_;
  TimeStepper* stepper_ = nullptr;
  Progress progress_;
  Drive drive_;
  Matrix4 world_from_object_;
  double time_s_ = 0.0;
  int num_frames_ = 0;
  std::optional<std::size_t> grip_frame_;
  bool restoring_ = true;
};

}  // namespace

Grasp grasp(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
            const GraspSpec& spec, const ProgressObserver& observe, ByteStore* store) {
  return Hand(sensor, gel, object, config, spec, observe, store).run();
}

}  // namespace tacipc
