#include "stages/gel/press/drive/hand.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/base/log.h"

namespace tacipc {
Ways Hand::pressing_n() const {
  const std::vector<Matrix4>& poses = world_.state().world_from_body;
  return {tacipc::pressing_n(force_on(0), poses[0]), tacipc::pressing_n(force_on(1), poses[1])};
}

/// Forces by which the drives are controlled: their mean if one drive closes both fingers.
Ways Hand::grips_n() const {
  Ways grips = pressing_n();
  if (!spec_.drive_each) grips.fill(0.5 * (grips[0] + grips[1]));
  return grips;
}

double Hand::grip_n() const {
  const Ways grips = grips_n();
  return 0.5 * (grips[0] + grips[1]);
}

bool Hand::arrived() const {
  const auto& [left, right] = state_.drives;
  if (left.by_way || !is_free()) return left.arrived(spec_.mount) && right.arrived(spec_.mount);
  // Separate drives may drift with the object indefinitely, with their damping force as the difference between the grip
  // forces.
  GripControl mean = left;
  mean.last_grip_n = grip_n();
  mean.velocity_m_s = 0.5 * (left.velocity_m_s + right.velocity_m_s);
  return mean.arrived(spec_.mount);
}

Ways Hand::let_go() {
  for (GripControl& drive : state_.drives) drive.let_go = true;
  state_.grip_n = grip_n();
  return pressing_n();
}

/// Poses of all bodies for a pose of the hand and displacements of the fingers; the object's pose is unchanged.
std::vector<Matrix4> Hand::poses(const Matrix4& world_from_hand, const Ways& closed_m) const {
  std::vector<Matrix4> all;
  for (const std::size_t side : {0, 1}) {
    Matrix4 pose = world_.body(side).start;
    pose.topRightCorner<3, 1>() += closed_m[side] * pose.topLeftCorner<3, 3>().col(2);
    all.push_back(world_from_hand * pose);
  }
  all.push_back(object_pose());
  return all;
}

/// Takes one time step. Divides it if the hand rotates too far for straight paths of the vertices, or if it does not
/// converge.
void Hand::step(double h_s, const Ways& closing_m, const RigidWay& motion, int halvings, StepReport& report) {
  const auto both_halves = [&](int deeper) {
    for (int half = 0; half < 2; ++half)
      step(0.5 * h_s, {0.5 * closing_m[0], 0.5 * closing_m[1]}, motion * 0.5, deeper, report);
  };
  if (motion.turn_rad.norm() > kLongestTurn_rad) return both_halves(halvings);
  auto& drives = state_.drives;
  const Ways closed{drives[0].closed_m + closing_m[0], drives[1].closed_m + closing_m[1]};
  const Matrix4 to = moved(state_.world_from_hand, motion);
  const std::vector<Matrix4> at_end = poses(to, closed);
  StepGoal goal = world_.goal(h_s);
  world_.move_mounts(goal, at_end);
  // Both mounts move with the hand, apart from their closing.
  goal.mount_motion.clear();
  goal.hand_motion = motion_of_world(state_.world_from_hand, motion);
  if (!is_free()) world_.hold(goal, 0, object_pose());
  const auto advance = [&] {
    StepReport done = world_.advance(goal, at_end, run_.observer());
    for (const std::size_t side : {0, 1}) drives[side].closed_m = closed[side];
    state_.world_from_hand = to;
    return done;
  };
  run_.advance_or_divide(halvings, config_.max_halvings, report, advance, both_halves);
}

void Hand::measured_step(double h_s, const Ways& closing_m, const RigidWay& motion, StepReport& report) {
  step(h_s, closing_m, motion, 0, report);
  const Ways grips = grips_n();
  for (const std::size_t side : {0, 1}) state_.drives[side].measure(h_s, closing_m[side], grips[side]);
}

void Hand::open_by(double way_m, double h_s, const RigidWay& motion, StepReport& report) {
  measured_step(h_s, {-way_m, -way_m}, motion, report);
  for (GripControl& drive : state_.drives) {
    drive.wanted_n = drive.last_grip_n;
    drive.wanted_closed_m = drive.closed_m;
  }
}

void Hand::go_on(double h_s, const RigidWay& motion, StepReport& report) {
  const double most = spec_.closing_speed_m_s * h_s;
  Ways ways{0.0, 0.0};
  for (const std::size_t side : {0, 1}) {
    const GripControl& drive = state_.drives[side];
    if (!lost()) ways[side] = std::clamp(drive.wanted_closed_m - drive.closed_m, -most, most);
  }
  measured_step(h_s, ways, motion, report);
}

/// Displacement of the object's centre of mass along the closing axis between two poses, minus that of the hand's
/// motion.
double Hand::along_axis(const Matrix4& from, const Matrix4& to, const Matrix4& motion, const Matrix4& hand) const {
  const Eigen::Vector4d center = grasp_.center_of_mass_m.homogeneous();
  const Vector3 axis = (motion * hand).col(0).head<3>();
  return axis.dot((to * center - motion * (from * center)).head<3>());
}

/// Search of a time step, from the state at its start. \param motion motion of the hand, in the world
PairSearch Hand::start_search(double h_s, const Matrix4& motion) {
  const auto begin = [&](std::size_t side) {
    return WaySearch(state_.drives[side], spec_.mount, h_s, spec_.closing_speed_m_s * h_s, world_.laws().reach_m(),
                     [&](double none) { return world_.smallest_gap(none); });
  };
  const WaySearch left = begin(0);
  // A held object decouples the drives.
  const bool coupled = spec_.drive_each && is_free();
  const double object_n_m = grasp_.mass_kg / (h_s * h_s);
  PairSearch search({left, spec_.drive_each ? begin(1) : left}, coupled, object_n_m);
  if (!coupled) return search;
  Matrix4 flown = object_pose();
  flown.topRightCorner<3, 1>() +=
      h_s * world_.state().motion.object_motion[0].velocity_m_s + h_s * h_s * spec_.gravity_m_s2;
  const double pressed_n = state_.drives[0].last_grip_n - state_.drives[1].last_grip_n;
  search.expect(object_n_m * along_axis(object_pose(), flown, motion, state_.world_from_hand) + pressed_n);
  return search;
}

void Hand::balance(double h_s, const RigidWay& hand, double enough_n, StepReport& report, int halvings) {
  const WorldState before = world_.state();
  const HandState hand_before = state_;
  const Matrix4 motion = motion_of_world(state_.world_from_hand, hand);
  PairSearch search = start_search(h_s, motion);
  const auto start_again = [&] {
    world_.state() = before;
    state_ = hand_before;
  };
  StepReport spent;
  std::optional<Ways> solved;
  bool gives_up = false;
  while (true) {
    const Ways ways = gives_up ? *solved : search.ways_m();
    StepReport done;
    try {
      step(h_s, ways, hand, 0, done);
    } catch (const SolverError& error) {
      // A step that is out of balance is better than none.
      if (!solved || gives_up) throw;
      log_info("frame {}: {}; the fingers go by a way that could be solved", run_.next(), error.what());
      gives_up = true;
      start_again();
      continue;
    }
    solved = ways;
    const Ways grips = grips_n();
    if (!gives_up)
      search.note(grips, along_axis(before.world_from_body[2], object_pose(), motion, hand_before.world_from_hand));
    // While the object is held and the grip is below its target, the rate at which it grows does not matter.
    const bool enough = !is_free() && spec_.mount.none() && std::max(grips[0], grips[1]) <= enough_n;
    if (gives_up || enough || search.stands()) {
      const double imbalance = enough ? 0.0 : search.imbalance();
      if (imbalance > kGripTolerance && halvings < config_.max_halvings) {
        log_info("frame {}: {:.3g} of the force is missing to the balance of a drive; dividing the time step",
                 run_.next(), imbalance);
        done.time_steps = 0;
        report.add_earlier(done);
        report.add_earlier(spent);
        start_again();
        for (int half = 0; half < 2; ++half) balance(0.5 * h_s, hand * 0.5, enough_n, report, halvings + 1);
        return;
      }
      done.add_earlier(spent);
      done.add_earlier(report);
      report = done;
      for (const std::size_t side : {0, 1})
        state_.drives[side].measure(h_s, ways[side], grips[side], search.found_n_m(side));
      imbalance_ = std::max(imbalance_, imbalance);
      return;
    }
    done.time_steps = 0;  // counted already: it is the same step
    done.add_earlier(spent);
    spent = done;
    start_again();
    search.correct();
  }
}

}  // namespace tacipc
