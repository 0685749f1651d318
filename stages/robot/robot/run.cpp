#include "stages/robot/robot/run.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "common/base/error.h"
#include "stages/robot/robot/controller.h"

namespace tacipc {
namespace {

using Pair = std::pair<std::string, std::string>;
constexpr const char* kGel = "gel";  // name of a gel's counterpart in the list of contacts

class Runner {
 public:
  Runner(const TaskSpec& task, RobotModel& robot, bool coupled)
      : task_(task), robot_(robot), coupled_(coupled), controller_(task, robot) {
    const double steps = task.frame_s / robot.model().opt.timestep;
    per_frame_ = static_cast<int>(std::lround(steps));
    if (per_frame_ < 1 || std::abs(steps - per_frame_) > 1e-6 * steps)
      throw UsageError(fmt::format("{}: frame_s, {:g} s, is not a whole number of the model's time steps, {:g} s",
                                   task.model.string(), task.frame_s, robot.model().opt.timestep));
    felt_.assign(task.pads.size(), {Vector3::Zero(), Vector3::Zero()});
  }

  RobotRun alone(const RobotProgress& progress) {
    std::vector<Matrix4> held;
    for (std::size_t i = 0; i < task_.objects.size(); ++i) held.push_back(robot_.body_pose(robot_.object_body(i)));
    const auto hold = [&] {
      for (std::size_t i = 0; i < task_.objects.size(); ++i) {
        if (robot_.data().time < task_.objects[i].held_s - 1e-9) robot_.put_object(i, held[i]);
      }
    };
    mj_step1(&robot_.model(), &robot_.data());
    note(0);
    for (int n = 1;; ++n) {
      progress(robot_.data().time);
      advance();
      hold();
      for (std::size_t p = 0; p < felt_.size(); ++p) felt_[p] = robot_.pad_contact(p);
      mj_step1(&robot_.model(), &robot_.data());
      note(n);
      if (n % per_frame_ == 0 && is_over()) break;
    }
    return finished();
  }

  /// Runs one window. Between two frames the wrenches on the pads are constant: those that the press returns for the
  /// end of the interval, because the press's time step is implicit. Both sides thus get opposite impulses.
  RobotRun window(const Window& window) {
    if (window.before) {
      run_ = *window.before;
      restore(run_.state);
      for (const ContactEvent& event : run_.events) {
        const Pair pair{event.first, event.second};
        event.begins ? void(touching_.insert(pair)) : void(touching_.erase(pair));
      }
      felt_ = run_.frames.back().pad_wrench;
    } else {
      mj_step1(&robot_.model(), &robot_.data());
      note(0);
    }
    if (window.answers) along_.assign(window.answers->inertia_n_m.size(), Vector3::Zero()), along_before_ = along_;
    for (int f = 1; f <= window.frames && !run_.finished; ++f) interval(window, f);
    return finished();
  }

 private:
  void interval(const Window& window, int frame) {
    const auto frames = static_cast<int>(run_.frames.size());
    put_objects(window, frame);
    const std::vector<double> start = state();
    const std::size_t pads = felt_.size();
    const auto set_forces = [&](const Eigen::VectorXd& forces) {
      for (std::size_t p = 0; p < pads; ++p) felt_[p].force_n = forces.segment<3>(static_cast<Eigen::Index>(3 * p));
    };
    const auto end = [&](const Eigen::VectorXd& forces) {
      restore(start);
      set_forces(forces);
      for (int n = 0; n < per_frame_; ++n) advance();
      mj_kinematics(&robot_.model(), &robot_.data());
      return origins();
    };
    const auto law = [&](const Eigen::VectorXd& at) { return forces_of(answered(window, frame, at)); };
    Eigen::VectorXd forces(static_cast<Eigen::Index>(3 * pads));
    for (std::size_t p = 0; p < pads; ++p) forces.segment<3>(static_cast<Eigen::Index>(3 * p)) = felt_[p].force_n;
    for (std::size_t p = 0; p < pads; ++p)
      felt_[p].torque_n_m =
          window.answers ? answer(window, frame, p).wrench.torque_n_m : window.at_start[p].wrench.torque_n_m;
    if (window.exact) {
      for (std::size_t p = 0; p < pads; ++p)
        forces.segment<3>(static_cast<Eigen::Index>(3 * p)) = answer(window, frame, p).wrench.force_n;
    } else {
      forces = balanced_forces(end, law, forces);
      // Without contact, the rest of Newton's method is rounding.
      const std::vector<Wrench> wrenches = answered(window, frame, end(forces));
      for (std::size_t p = 0; p < pads; ++p) {
        if (wrenches[p].force_n != Vector3::Zero()) continue;
        forces.segment<3>(static_cast<Eigen::Index>(3 * p)).setZero();
        felt_[p].torque_n_m.setZero();
      }
    }
    restore(start);
    set_forces(forces);
    for (int n = 0; n < per_frame_; ++n) {
      advance();
      mj_step1(&robot_.model(), &robot_.data());
      note((frames - 1) * per_frame_ + n + 1);
    }
    if (window.answers) {
      std::vector<Vector3> along = felt_at(window, frame, origins()).along_m;
      along_before_ = std::exchange(along_, std::move(along));
    }
    run_.finished = is_over();
  }

  /// Returns whether the task's steps are over now, without setting controls, which belong to the next time step.
  bool is_over() {
    const std::vector<double> last = state();
    act();
    const bool over = controller_.done();
    restore(last);
    return over;
  }

  void act() {
    std::vector<double> forces;
    for (const Wrench& wrench : felt_) forces.push_back(wrench.force_n.norm());
    controller_.act(forces);
  }

  /// Advances the model by one time step.
  void advance() {
    const double time_s = robot_.data().time;
    mj_step1(&robot_.model(), &robot_.data());
    act();
    if (coupled_) {
      robot_.forget_pushes();
      for (std::size_t p = 0; p < felt_.size(); ++p) robot_.push_pad(p, felt_[p]);
    }
    mj_step2(&robot_.model(), &robot_.data());
    robot_.check(time_s);
  }

  Eigen::VectorXd origins() const {
    Eigen::VectorXd all(static_cast<Eigen::Index>(3 * felt_.size()));
    for (std::size_t p = 0; p < felt_.size(); ++p)
      all.segment<3>(static_cast<Eigen::Index>(3 * p)) = robot_.pad_pose(p).topRightCorner<3, 1>();
    return all;
  }

  static Eigen::VectorXd forces_of(const std::vector<Wrench>& wrenches) {
    Eigen::VectorXd all(static_cast<Eigen::Index>(3 * wrenches.size()));
    for (std::size_t p = 0; p < wrenches.size(); ++p)
      all.segment<3>(static_cast<Eigen::Index>(3 * p)) = wrenches[p].force_n;
    return all;
  }

  static std::size_t index_of(const Window& window, int frame) {
    return std::min(static_cast<std::size_t>(frame), window.answers->frames.size() - 1);
  }

  const PadAnswer& answer(const Window& window, int frame, std::size_t pad) const {
    return window.answers->frames[index_of(window, frame)][pad];
  }

  std::vector<Vector3> origins_in(const Eigen::VectorXd& at) const {
    std::vector<Vector3> all;
    for (std::size_t p = 0; p < felt_.size(); ++p) all.emplace_back(at.segment<3>(static_cast<Eigen::Index>(3 * p)));
    return all;
  }

  /// Evaluates the surrogate law with the responses to an earlier iteration. A floating object continues the
  /// displacement from its pose in the responses that it had in the frames before; an object held by others returns to
  /// that pose.
  FeltWrenches felt_at(const Window& window, int frame, const Eigen::VectorXd& at) const {
    const WindowAnswers& answers = *window.answers;
    const std::size_t f = index_of(window, frame);
    std::vector<Vector3> expected;
    for (std::size_t o = 0; o < along_.size(); ++o)
      expected.push_back(answers.floats[f][o] ? Vector3(2.0 * along_[o] - along_before_[o]) : Vector3(Vector3::Zero()));
    return felt_wrenches(answers.frames[f], origins_in(at), answers.stiffness_n_m[f], answers.inertia_n_m, expected);
  }

  /// Returns the wrenches of the gels with their origins at these positions at the end of a frame of the window.
  std::vector<Wrench> answered(const Window& window, int frame, const Eigen::VectorXd& at) const {
    if (window.answers) return felt_at(window, frame, at).wrenches;
    std::vector<Wrench> wrenches;
    const std::vector<Vector3> origins = origins_in(at);
    // A held object moves with the hand: the pads' mean displacement adds no compression. A single pad holds nothing.
    Vector3 mean = Vector3::Zero();
    for (std::size_t p = 0; felt_.size() > 1 && p < felt_.size(); ++p)
      mean +=
          (origins[p] - window.at_start[p].world_from_gel.topRightCorner<3, 1>()) / static_cast<double>(felt_.size());
    for (std::size_t p = 0; p < felt_.size(); ++p) {
      PadAnswer moved = window.at_start[p];
      moved.world_from_gel.topRightCorner<3, 1>() += mean;
      wrenches.push_back(felt_wrench(moved, origins[p], window.stiffness_n_m));
    }
    return wrenches;
  }

  void put_objects(const Window& window, int frame) {
    const auto& poses =
        window.answers
            ? window.answers->objects[std::min(static_cast<std::size_t>(frame), window.answers->objects.size() - 1)]
            : window.objects_at_start;
    std::size_t rigid = 0;
    for (std::size_t i = 0; i < task_.objects.size(); ++i) {
      if (!task_.objects[i].fixed) robot_.put_object(i, poses[rigid++]);
    }
  }

  /// Records a frame, if one is due, and contacts that began or ended.
  void note(int n) {
    const mjModel& m = robot_.model();
    const mjData& d = robot_.data();
    std::set<Pair> now;
    for (int c = 0; c < d.ncon; ++c) {
      if (d.contact[c].dist < 0.0)
        now.emplace(robot_.name(mjOBJ_GEOM, d.contact[c].geom1), robot_.name(mjOBJ_GEOM, d.contact[c].geom2));
    }
    for (std::size_t p = 0; p < felt_.size(); ++p) {
      if (felt_[p].force_n != Vector3::Zero()) now.emplace(task_.pads[p].name, kGel);
    }
    for (const Pair& pair : touching_) {
      if (!now.contains(pair)) run_.events.push_back({d.time, pair.first, pair.second, false});
    }
    for (const Pair& pair : now) {
      if (!touching_.contains(pair)) run_.events.push_back({d.time, pair.first, pair.second, true});
    }
    touching_ = std::move(now);
    if (n % per_frame_ != 0) return;
    // Times of frames are multiples of frame_s, because summed times of the model accumulate rounding.
    RobotFrame frame;
    const int number = n / per_frame_;
    frame.time_s = number * task_.frame_s;
    frame.step = static_cast<int>(controller_.step());
    frame.qpos.assign(d.qpos, d.qpos + m.nq);
    frame.qvel.assign(d.qvel, d.qvel + m.nv);
    frame.control.assign(d.ctrl, d.ctrl + m.nu);
    frame.actuator_force.assign(d.actuator_force, d.actuator_force + m.nu);
    for (int body = 1; body < m.nbody; ++body) {
      frame.body_pose.push_back(robot_.body_pose(body));
      frame.body_twist.push_back(robot_.body_twist(body));
    }
    for (std::size_t p = 0; p < felt_.size(); ++p) frame.pad_pose.push_back(robot_.pad_pose(p));
    frame.pad_wrench = felt_;
    run_.frames.push_back(std::move(frame));
  }

  std::vector<double> state() const {
    const mjModel& m = robot_.model();
    const mjData& d = robot_.data();
    std::vector<double> all{d.time};
    const auto add = [&](const mjtNum* values, int count) { all.insert(all.end(), values, values + count); };
    add(d.qpos, m.nq), add(d.qvel, m.nv), add(d.act, m.na), add(d.qacc_warmstart, m.nv), add(d.ctrl, m.nu);
    add(d.mocap_pos, 3 * m.nmocap), add(d.mocap_quat, 4 * m.nmocap);
    add(d.actuator_force, m.nu);  // shown in the frame at this instant
    const std::vector<double> control = controller_.state();
    all.insert(all.end(), control.begin(), control.end());
    return all;
  }

  void restore(const std::vector<double>& state) {
    const mjModel& m = robot_.model();
    mjData& d = robot_.data();
    const auto own = static_cast<std::size_t>(1 + m.nq + 2 * m.nv + m.na + 2 * m.nu + 7 * m.nmocap);
    if (state.size() < own) throw DataError("a saved state is of another model");
    const double* at = state.data();
    d.time = *at++;
    const auto take = [&](mjtNum* values, int count) { std::copy_n(at, count, values), at += count; };
    take(d.qpos, m.nq), take(d.qvel, m.nv), take(d.act, m.na), take(d.qacc_warmstart, m.nv), take(d.ctrl, m.nu);
    take(d.mocap_pos, 3 * m.nmocap), take(d.mocap_quat, 4 * m.nmocap);
    take(d.actuator_force, m.nu);
    controller_.restore({state.begin() + static_cast<std::ptrdiff_t>(own), state.end()});
  }

  RobotRun finished() {
    run_.state = state();
    return std::move(run_);
  }

  const TaskSpec& task_;
  RobotModel& robot_;
  const bool coupled_;
  Controller controller_;
  RobotRun run_;
  std::set<Pair> touching_;
  std::vector<Wrench> felt_;  // current wrench on each pad
  // Displacement of each object from its pose in the last responses, at the last two frames of the window.
  std::vector<Vector3> along_, along_before_;
  int per_frame_ = 1;
};

}  // namespace

RobotRun run_alone(const TaskSpec& task, RobotModel& robot, const RobotProgress& progress) {
  RobotRun run = Runner(task, robot, false).alone(progress);
  run.finished = true;
  return run;
}

TryJudgement judge_try(const TaskSpec& task, const RobotRun& tried, std::size_t first,
                       const std::vector<std::vector<PadAnswer>>& basis, double stiffness_n_m, WindowAnswers& answers) {
  if (tried.frames.size() != first + answers.frames.size())
    throw DataError("the press answered {} frames, and its try has {}", first + answers.frames.size(),
                    tried.frames.size());
  std::vector<Wrench> felt, answered;
  std::vector<PadAnswer> all;
  for (std::size_t f = 0; f < answers.frames.size(); ++f) {
    all.insert(all.end(), answers.frames[f].begin(), answers.frames[f].end());
    // The first instant of the window is given.
    for (std::size_t p = 0; f > 0 && p < task.pads.size(); ++p) {
      felt.push_back(tried.frames[first + f].pad_wrench[p]);
      answered.push_back(answers.frames[f][p].wrench);
    }
  }
  const double stiffness = learnt_stiffness(all).value_or(stiffness_n_m);
  for (std::size_t f = 0; f < answers.frames.size(); ++f) {
    auto& of_frame = answers.stiffness_n_m.emplace_back(task.pads.size(), stiffness);
    for (std::size_t p = 0; f < basis.size() && p < task.pads.size(); ++p)
      of_frame[p] = secant_stiffness(basis[f][p], answers.frames[f][p], stiffness);
  }
  return {interface_residual(felt, answered, task.coupling.smallest_wrench_n), stiffness};
}

double position_residual_m(const RobotRun& run, std::size_t first, const WindowAnswers& answers) {
  constexpr double kArm_m = 0.01;  // arm on which a rotation counts
  if (run.frames.size() != first + answers.frames.size()) return std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  for (std::size_t f = 1; f < answers.frames.size(); ++f) {
    for (std::size_t p = 0; p < answers.frames[f].size(); ++p) {
      const Matrix4 apart = answers.frames[f][p].world_from_gel.inverse() * run.frames[first + f].pad_pose[p];
      const double turn = Eigen::AngleAxisd(Matrix3(apart.topLeftCorner<3, 3>())).angle();
      farthest = std::max({farthest, apart.topRightCorner<3, 1>().norm(), kArm_m * turn});
    }
  }
  return farthest;
}

RobotRun run_window(const TaskSpec& task, RobotModel& robot, const Window& window) {
  return Runner(task, robot, true).window(window);
}

}  // namespace tacipc
