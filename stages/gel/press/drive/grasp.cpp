#include "stages/gel/press/drive/grasp.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/sample/rigid_way.h"
#include "stages/gel/press/contact/intersection_check.h"
#include "stages/gel/press/drive/checkpoint.h"
#include "stages/gel/press/drive/grasp_labels.h"
#include "stages/gel/press/drive/grasp_outcome.h"
#include "stages/gel/press/drive/grip.h"
#include "stages/gel/press/drive/hand.h"

namespace tacipc {
namespace {

/// Limit of additional time steps after the frames of a phase in which fingers close.
constexpr int kMostClosingSteps = 200;

/// Motion of the hand since the start of a phase, at a fraction of the phase.
RigidWay hand_in(const GraspPhase& phase, double fraction, double seconds) {
  RigidWay hand;
  const double smooth = smooth_part(fraction);
  if (phase.kind == PhaseKind::lift) hand.shift_m.z() = phase.distance_m * smooth;
  if (phase.kind == PhaseKind::shake)
    hand.shift_m[phase.axis] =
        0.5 * phase.amplitude_m * (1.0 - std::cos(2.0 * std::numbers::pi * phase.frequency_hz * seconds));
  if (phase.kind == PhaseKind::turn) hand.turn_rad[phase.axis] = phase.angle_rad * smooth;
  return hand;
}

/// Sets the force or displacement that the drives should have reached at a fraction of a phase.
/// \param from drives at its start
void set_goal(const GraspPhase& phase, double fraction, const std::array<GripControl, 2>& from, const Grip& grip,
              std::array<GripControl, 2>& drives) {
  const double mean_m = 0.5 * (from[0].closed_m + from[1].closed_m);
  for (const std::size_t side : {0, 1}) {
    if (phase.kind == PhaseKind::approach) {
      drives[side].go_to(grip.start_gap_m - phase.gap_m);
    } else if (phase.kind == PhaseKind::close && phase.width_m) {
      drives[side].go_to(from[side].closed_m + fraction * (0.5 * (grip.start_width_m - *phase.width_m) - mean_m));
    } else if (phase.kind == PhaseKind::close) {
      drives[side].grip(from[side].wanted_n + fraction * (phase.force_n - from[side].wanted_n));
    }
  }
}

[[noreturn]] void throw_not_closed(const std::array<GripControl, 2>& drives, const DriveInertia& mount) {
  const GripControl& drive = drives[drives[0].arrived(mount) ? 1 : 0];
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

class GraspDrive {
 public:
  GraspDrive(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
             const GraspSpec& spec, const ProgressObserver& observe, FrameStore* store)
      : object_(object),
        spec_(spec),
        config_(spec.pressed_with(config)),
        grip_(make_grip(sensor, gel, object, config_, spec, out_)),
        world_(sensor, config_, std::move(grip_.bodies), {.gravity_m_s2 = spec.gravity_m_s2}),
        run_(num_frames(spec.motion), observe, store),
        hand_(spec, config_, out_, world_, run_) {
    for (const std::size_t side : {0, 1}) out_.fingers[side] = world_.simulation_of(side);
  }

  Grasp run() {
    if (!restored()) {
      world_.require_apart();
      finish(PhaseKind::reference, -1, {});
    }
    for (std::size_t p = 0; p < spec_.motion.size(); ++p) run_phase(spec_.motion[p], static_cast<int>(p));
    for (Simulation& finger : out_.fingers) finger.times = world_.stepper().times();
    out_.grip_n = hand_.state().grip_n;
    out_.freed_frame = *freed_frame_;
    if (config_.friction)
      out_.slip_speed_m_s = friction_settings(*config_.friction, world_.scales()).speed_threshold_m_s;
    judge_outcome(out_);
    return std::move(out_);
  }

 private:
  void run_phase(const GraspPhase& phase, int index) {
    const double h = config_.time_step_s;
    const int steps = phase.steps * phase.substeps;
    const bool closes = phase.kind == PhaseKind::close, goes_on = closes || phase.kind == PhaseKind::approach;
    const std::array<GripControl, 2> from = hand_.state().drives;
    const auto hand_at = [&](int i) { return hand_in(phase, 1.0 * i / steps, i * h); };
    for (int f = 1; f <= phase.steps; ++f) {
      if (restored()) continue;
      const bool last = f == phase.steps;
      const StepReport report = run_.solve([&](StepReport& sum) {
        for (int i = (f - 1) * phase.substeps; i < f * phase.substeps; ++i) {
          set_goal(phase, (i + 1.0) / steps, from, grip_, hand_.state().drives);
          const double enough_n = closes && !phase.width_m && i + 1 < steps ? phase.force_n : 0.0;
          time_step(phase, hand_at(i + 1) - hand_at(i), enough_n, sum);
        }
        // Additional time steps until the fingers have reached their goal. In the first `close` the object is held
        // meanwhile.
        for (int more = 0; goes_on && last && !hand_.lost() && !hand_.arrived(); ++more) {
          if (more == kMostClosingSteps) throw_not_closed(hand_.state().drives, spec_.mount);
          time_step(phase, {}, 0.0, sum);
        }
      });
      if (closes && last && !hand_.is_free()) let_go();
      finish(phase.kind, index, report);
    }
  }

  void time_step(const GraspPhase& phase, const RigidWay& motion, double enough_n, StepReport& report) {
    const double h = config_.time_step_s;
    world_.state().time_s += h;
    if (phase.kind == PhaseKind::release) {
      hand_.open_by(phase.distance_m / (phase.steps * phase.substeps), h, motion, report);
    } else if (hand_.lost() || hand_.state().drives[0].by_way) {
      hand_.go_on(h, motion, report);
    } else {
      hand_.balance(h, motion, enough_n, report);
    }
  }

  /// Frees the object once the fingers have closed on it.
  void let_go() {
    const Ways pressing = hand_.let_go();
    const auto [left, right] = pressing;
    if (std::abs(left - right) > kUneven * (left + right))
      log_warning(
          "frame {}: when the object was freed the left finger pressed with {:.3g} N and the right one with {:.3g} N: "
          "it will shift towards the weaker; choose fingers.grip_mm or turn_deg so that both press alike, or "
          "fingers.drive: each",
          run_.next(), left, right);
  }

  bool restored() {
    const std::optional<std::string> bytes = run_.restored();
    if (!bytes) return false;
    GraspFrame frame;
    std::vector<Frame> fingers;
    GraspProgress progress;
    unpack_frame(*bytes, frame, fingers, progress);
    require_gels(fingers.size(), 2);
    world_.state() = std::move(progress.world);
    hand_.state() = progress.hand;
    keep(frame, fingers);
    return true;
  }

  void keep(const GraspFrame& frame, std::vector<Frame>& fingers) {
    for (const std::size_t side : {0, 1}) out_.fingers[side].frames.push_back(std::move(fingers[side]));
    out_.frames.push_back(frame);
    if (!freed_frame_ && hand_.is_free()) freed_frame_ = out_.frames.size() - 1;
  }

  /// Measures and judges a frame, writes its line of the log, and saves it.
  void finish(PhaseKind phase, int phase_index, const StepReport& report) {
    std::vector<Frame> fingers = world_.measure(phase, phase_index, report);
    const WorldState& state = world_.state();
    GraspFrame frame{.time_s = state.time_s,
                     .phase = phase,
                     .world_from_hand = hand_.state().world_from_hand,
                     .world_from_finger = {state.world_from_body[0], state.world_from_body[1]},
                     .world_from_object = state.world_from_body[2],
                     .velocity_m_s = state.motion.object_motion[0].velocity_m_s,
                     .spin_rad_s = world_.spin_rad_s(0),
                     .grip_imbalance = hand_.take_imbalance(),
                     .whole = world_.take_account()};
    const Positions object_at = world_.mesh().object_rows(state.motion.x);
    for (const std::size_t side : {0, 1}) {
      const SolvedGel gel = world_.deformable(side);
      const GripControl& drive = hand_.state().drives[side];
      frame.drives[side] = {drive.wanted_n, drive.closed_m, drive.velocity_m_s};
      fingers[side].gel_in_object =
          winding_number(state.motion.x.row(gel.first_row + gel.front.vertices[0]), {object_at, object_.triangles});
      if (phase_index >= 0) frame.force_on_finger_n[side] = hand_.force_on(side);
    }
    world_.judge(run_.next(), fingers);
    judge_grip(run_.next(), frame.grip_imbalance);
    if (freed_frame_) {
      const InHand since = motion_in_hand(out_.frames[*freed_frame_], frame, out_.grip_point());
      frame.slip_m = since.slip_m;
      frame.turn_rad = since.turn_rad;
    }
    log_info(
        "frame {}/{} {}: grip {:.3f} N, carried {:.4f} N, slipped {:.3f} mm, turned {:.2f} deg, {} Newton iterations "
        "in {} steps, smallest gap {}",
        run_.next(), run_.num_frames(), name_of(phase), phase_index < 0 ? 0.0 : hand_.grip_n(),
        -(frame.force_on_finger_n[0] + frame.force_on_finger_n[1]).z(), 1e3 * frame.slip_m,
        frame.turn_rad * 180.0 / std::numbers::pi, report.newton_iterations, report.time_steps,
        gap_text(fingers[0].min_gap_m));
    run_.save([&] { return pack_frame(frame, fingers, {state, hand_.state()}); });
    keep(frame, fingers);
  }

  const TriangleMesh& object_;
  const GraspSpec& spec_;
  const PressConfig config_;
  Grasp out_;
  Grip grip_;  // poses in frame 0; the bodies are moved into the world
  World world_;
  FrameRun run_;
  Hand hand_;
  std::optional<std::size_t> freed_frame_;
};

}  // namespace

Grasp grasp(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
            const GraspSpec& spec, const ProgressObserver& observe, FrameStore* store) {
  return GraspDrive(sensor, gel, object, config, spec, observe, store).run();
}

}  // namespace tacipc
