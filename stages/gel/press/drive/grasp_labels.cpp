#include "stages/gel/press/drive/grasp_labels.h"

#include <algorithm>
#include <cmath>

#include "stages/gel/press/drive/grasp_outcome.h"

namespace tacipc {
namespace {

/// Friction that the object needs to move with the hand, over the largest possible friction.
struct Load {
  double weight = 0.0;  // m g across the closing axis / μ N
  double force = 0.0;   // m |g − a| across the closing axis / μ N
  double torque = 0.0;  // torque of m (g − a) about the closing axis through the grip point / μ Σ N ρ

  double use() const { return std::hypot(force, torque); }
};

double part_of(double asked, double given) { return asked == 0.0 ? 0.0 : asked / given; }

/// Second difference over three frames, which need not be equally spaced.
Vector3 acceleration(const std::array<Vector3, 3>& at_m, const std::array<double, 3>& time_s) {
  const double before = time_s[1] - time_s[0], after = time_s[2] - time_s[1];
  return 2.0 / (before + after) * ((at_m[2] - at_m[1]) / after - (at_m[1] - at_m[0]) / before);
}

Load load_in(const Grasp& grasp, std::size_t f) {
  const Matrix4 in_hand = hand_from_object(grasp.frames[grasp.freed_frame]);
  const auto carried = [&](std::size_t frame, const Vector3& point_m) -> Vector3 {
    return (grasp.frames[frame].world_from_hand * in_hand * point_m.homogeneous()).head<3>();
  };
  const auto center = [&](std::size_t frame) { return carried(frame, grasp.center_of_mass_m); };
  Vector3 pull_n = grasp.mass_kg * grasp.gravity_m_s2;
  const GraspFrame& now = grasp.frames[f];
  const Vector3 axis = now.world_from_hand.col(0).head<3>();
  const auto across = [&](const Vector3& force_n) { return (force_n - axis.dot(force_n) * axis).norm(); };
  double bears_n = 0.0, bears_n_m = 0.0;
  for (const std::size_t side : {0, 1}) {
    bears_n += grasp.friction * now.grip_n(side);
    bears_n_m += grasp.friction * now.grip_n(side) * grasp.contacts[f][side].friction_radius_m;
  }
  Load load{.weight = part_of(across(pull_n), bears_n)};
  if (f + 1 < grasp.frames.size())
    pull_n -= grasp.mass_kg * acceleration({center(f - 1), center(f), center(f + 1)},
                                           {grasp.frames[f - 1].time_s, now.time_s, grasp.frames[f + 1].time_s});
  load.force = part_of(across(pull_n), bears_n);
  const Vector3 arm = center(f) - carried(f, grasp.grip_point());
  load.torque = part_of(std::abs(axis.dot(arm.cross(pull_n))), bears_n_m);
  return load;
}

SlipTimes slip_times(const Grasp& grasp, std::size_t side) {
  SlipTimes times;
  std::size_t before = grasp.freed_frame;  // last frame before a sequence of frames with gross slip
  for (std::size_t f = grasp.freed_frame + 1; f <= grasp.judged_frame; ++f) {
    const double share = grasp.contacts[f][side].slip_share;
    if (share >= kFirstSlipShare && !times.first_s) times.first_s = grasp.frames[f].time_s;
    if (share < kGrossSlipShare) {
      before = f;
      continue;
    }
    const InHand moved = motion_in_hand(grasp.frames[before], grasp.frames[f], grasp.grip_point());
    if (!times.gross_s && (moved.slip_m >= kGrossSlip_m || moved.turn_rad >= kGrossTurn_rad))
      times.gross_s = grasp.frames[before + 1].time_s;
  }
  return times;
}

}  // namespace

FingerContact finger_contact(const FrontSurface& front, const Frame& frame) {
  const Positions at = on_front(front, frame.positions);
  double all_n = 0.0, slipping_n = 0.0;
  Eigen::RowVector2d center = Eigen::RowVector2d::Zero();
  const Eigen::VectorXd normal_n = frame.normal_force_n.rowwise().norm();
  for (Eigen::Index v = 0; v < normal_n.size(); ++v) {
    all_n += normal_n[v];
    center += normal_n[v] * at.row(v).head<2>();
    if (frame.contact_state[static_cast<std::size_t>(v)] == ContactState::slip) slipping_n += normal_n[v];
  }
  if (!(all_n > kTouches_n)) return {};
  center /= all_n;
  double moment = 0.0;
  for (Eigen::Index v = 0; v < normal_n.size(); ++v) moment += normal_n[v] * (at.row(v).head<2>() - center).norm();
  return {.slip_share = slipping_n / all_n, .friction_radius_m = moment / all_n};
}

void measure_creep(Grasp& grasp) {
  grasp.contacts.clear();
  for (std::size_t f = 0; f < grasp.frames.size(); ++f) {
    auto& of_frame = grasp.contacts.emplace_back();
    for (const std::size_t side : {0, 1})
      of_frame[side] = finger_contact(grasp.fingers[side].front, grasp.fingers[side].frames[f]);
  }
  HeldPath path(hand_from_object(grasp.frames[grasp.freed_frame]), grasp.grip_point(), grasp.slip_speed_m_s);
  for (std::size_t f = grasp.freed_frame + 1; f <= grasp.judged_frame; ++f) {
    const auto& [left, right] = grasp.contacts[f];
    GraspFrame& frame = grasp.frames[f];
    path.go_on(hand_from_object(frame), {.seconds = frame.time_s - grasp.frames[f - 1].time_s,
                                         .slip_share = std::max(left.slip_share, right.slip_share),
                                         .radius_m = std::max(left.friction_radius_m, right.friction_radius_m)});
    frame.slid_m = path.slip_m();
    frame.slid_rad = path.slip_rad();
    frame.creep_m = path.creep_m();
    frame.creep_rad = path.creep_rad();
  }
}

void add_labels(Grasp& grasp) {
  for (const std::size_t side : {0, 1}) grasp.slips[side] = slip_times(grasp, side);
  std::optional<GraspReason> first;
  for (std::size_t f = grasp.freed_frame; f <= grasp.judged_frame && is_held(grasp.frames[f]); ++f) {
    const Load load = load_in(grasp, f);
    grasp.friction_use.push_back(load.use());
    if (first || load.use() <= 1.0) continue;
    first = load.weight > 1.0  ? GraspReason::weight
            : load.force > 1.0 ? GraspReason::acceleration
                               : GraspReason::torque;
  }
  if (grasp.outcome == GraspOutcome::lifted) return;
  const GraspFrame& freed = grasp.frames[grasp.freed_frame];
  const double left = freed.grip_n(0), right = freed.grip_n(1);
  const bool uneven = std::abs(left - right) > kUneven * (left + right);
  grasp.reason = both_touch(freed) ? first.value_or(uneven ? GraspReason::uneven_grip : GraspReason::other)
                                   : GraspReason::no_contact;
}

void judge_outcome(Grasp& grasp) {
  // Fingers that open lose the object in any case.
  const auto released = std::find_if(grasp.frames.begin(), grasp.frames.end(),
                                     [](const GraspFrame& frame) { return frame.phase == PhaseKind::release; });
  grasp.judged_frame = static_cast<std::size_t>(released - grasp.frames.begin()) - 1;
  measure_creep(grasp);
  grasp.outcome = outcome_of(grasp);
  add_labels(grasp);
}

}  // namespace tacipc
