#include "stages/robot/robot/controller.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/format/npy_pose.h"
#include "common/sample/rigid_way.h"

namespace tacipc {
namespace {

// Inverse kinematics: iterations, tolerance, damping at singular directions; largest errors of a reached target.
constexpr int kMostIterations = 30;
constexpr double kNear = 1e-9, kDamping = 1e-4;
constexpr double kReached_m = 1e-4, kReached_rad = 1e-2;

}  // namespace

Controller::Controller(const TaskSpec& task, RobotModel& robot) : task_(task), robot_(robot), plan_(robot.make_data()) {
  const mjModel& m = robot.model();
  for (int a = 0; a < m.nu; ++a) {
    if (is_servo(m, a)) servos_.push_back({a, m.actuator_trnid[2 * a]});
  }
  for (const TaskStep& step : task.steps) {
    for (const auto* named : {&step.set, &step.limit}) {
      for (const auto& [name, value] : *named) robot.id(mjOBJ_ACTUATOR, name);
    }
    for (const std::string& site : {step.site, step.until ? step.until->site : std::string()}) {
      if (!site.empty()) robot.id(mjOBJ_SITE, site);
    }
  }
  begin_step(0.0);
}

Matrix4 Controller::site_pose(const mjData& data, int site) const {
  return pose_from(data.site_xpos + 3 * site, data.site_xmat + 9 * site);
}

void Controller::set_servos(mjData& data) const {
  const mjModel& m = robot_.model();
  for (const Servo& servo : servos_) data.qpos[m.jnt_qposadr[servo.joint]] = robot_.data().ctrl[servo.actuator];
}

void Controller::begin_step(double time_s) {
  const mjModel& m = robot_.model();
  const mjData& d = robot_.data();
  started_s_ = time_s;
  start_control_.assign(d.ctrl, d.ctrl + m.nu);
  start_qpos_.assign(d.qpos, d.qpos + m.nq);
  start_limit_.clear();
  for (int a = 0; a < m.nu; ++a)
    start_limit_.push_back(m.actuator_forcelimited[a] ? m.actuator_forcerange[2 * a + 1] : 0.0);
  if (done()) return;
  const TaskStep& step = task_.steps[step_];
  if (step.site.empty()) return;
  // Start from the commanded pose, not from the pose under the arm's weight.
  std::copy(start_qpos_.begin(), start_qpos_.end(), plan_->qpos);
  set_servos(*plan_);
  mj_kinematics(&m, plan_.get());
  start_site_ = site_pose(*plan_, robot_.id(mjOBJ_SITE, step.site));
}

void Controller::set_limits(const TaskStep& step, double part) {
  mjModel& m = robot_.model();
  for (const auto& [name, limit] : step.limit) {
    const int actuator = robot_.id(mjOBJ_ACTUATOR, name);
    const double from = start_limit_[static_cast<std::size_t>(actuator)];
    const double now = from > 0.0 ? from + part * (limit - from) : limit;
    m.actuator_forcelimited[actuator] = 1;
    m.actuator_forcerange[2 * actuator] = -now;
    m.actuator_forcerange[2 * actuator + 1] = now;
  }
}

bool Controller::over(const TaskStep& step, const std::vector<double>& pads) const {
  if (!step.until) return false;
  if (!step.until->pad.empty()) {
    for (std::size_t p = 0; p < task_.pads.size(); ++p) {
      if (task_.pads[p].name == step.until->pad) return pads[p] >= step.until->force_n;
    }
  }
  const double height = robot_.data().site_xpos[3 * robot_.id(mjOBJ_SITE, step.until->site) + 2];
  return step.until->above_m ? height >= *step.until->above_m : height <= *step.until->below_m;
}

void Controller::act(const std::vector<double>& pads) {
  mjData& d = robot_.data();
  while (!done()) {
    const TaskStep& step = task_.steps[step_];
    const double elapsed = d.time - started_s_;
    // The last control of a finished step stays: its end, or where its condition was met. The tolerance covers rounding
    // of summed times.
    const bool at_end = elapsed >= step.seconds - 1e-9, early = !at_end && over(step, pads);
    if (!early) {
      const double part = at_end ? 1.0 : std::max(0.0, elapsed / step.seconds);
      const double share = step.smooth ? smooth_part(part) : part;
      for (const auto& [name, value] : step.set) {
        const int a = robot_.id(mjOBJ_ACTUATOR, name);
        const double from = start_control_[static_cast<std::size_t>(a)];
        d.ctrl[a] = from + share * (value - from);
      }
      set_limits(step, share);
      if (!step.site.empty()) follow(step, share, std::min(elapsed, step.seconds));
    }
    if (!at_end && !early) return;
    ++step_;
    begin_step(d.time);
  }
}

void Controller::follow(const TaskStep& step, double part, double elapsed_s) {
  const mjModel& m = robot_.model();
  const int site = robot_.id(mjOBJ_SITE, step.site);
  Vector3 by = step.to_m ? Vector3(*step.to_m - start_site_.topRightCorner<3, 1>()) : step.by_m;
  by *= part;
  if (step.frequency_hz > 0.0) {
    // Whole periods, so that the motion ends at rest.
    const double periods = std::max(1.0, std::round(step.frequency_hz * step.seconds));
    by = 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * periods * elapsed_s / step.seconds)) * step.shake_m;
  }
  const Matrix4 target = moved(start_site_, {by, part * step.turn_rad});
  std::copy(start_qpos_.begin(), start_qpos_.end(), plan_->qpos);
  set_servos(*plan_);
  Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor> all(6, m.nv);
  Eigen::Matrix<double, 6, Eigen::Dynamic> J(6, static_cast<Eigen::Index>(servos_.size()));
  double missing_m = 0.0, missing_rad = 0.0;
  for (int i = 0; i < kMostIterations; ++i) {
    mj_kinematics(&m, plan_.get());
    mj_comPos(&m, plan_.get());
    const Matrix4 now = site_pose(*plan_, site);
    Eigen::Matrix<double, 6, 1> error;
    error.head<3>() = (target - now).topRightCorner<3, 1>();
    const Eigen::AngleAxisd turn(Matrix3(target.topLeftCorner<3, 3>() * now.topLeftCorner<3, 3>().transpose()));
    error.tail<3>() = turn.angle() * turn.axis();
    missing_m = error.head<3>().norm(), missing_rad = error.tail<3>().norm();
    if (error.norm() < kNear) break;
    mj_jacSite(&m, plan_.get(), all.data(), all.data() + 3 * m.nv, site);
    for (std::size_t s = 0; s < servos_.size(); ++s)
      J.col(static_cast<Eigen::Index>(s)) = all.col(m.jnt_dofadr[servos_[s].joint]);
    const Eigen::Matrix<double, 6, 6> A =
        J * J.transpose() + kDamping * kDamping * Eigen::Matrix<double, 6, 6>::Identity();
    const Eigen::VectorXd way = J.transpose() * A.ldlt().solve(error);
    for (std::size_t s = 0; s < servos_.size(); ++s)
      plan_->qpos[m.jnt_qposadr[servos_[s].joint]] += way[static_cast<Eigen::Index>(s)];
  }
  if (missing_m > kReached_m || missing_rad > kReached_rad)
    throw DataError("step {}: site {} cannot go there: at {:.3f} s {:.2g} mm and {:.2g} rad are missing", step_ + 1,
                    step.site, robot_.data().time, 1e3 * missing_m, missing_rad);
  for (const Servo& servo : servos_) {
    const double q = plan_->qpos[m.jnt_qposadr[servo.joint]];
    const mjtNum* range = m.jnt_range + 2 * servo.joint;
    if (m.jnt_limited[servo.joint] && (q < range[0] || q > range[1]))
      throw DataError("step {}: site {} cannot go there: at {:.3f} s joint {} would be at {:.4g}, beyond its range",
                      step_ + 1, step.site, robot_.data().time, robot_.name(mjOBJ_JOINT, servo.joint), q);
    robot_.data().ctrl[servo.actuator] = q;
  }
}

std::vector<double> Controller::state() const {
  std::vector<double> all{static_cast<double>(step_), started_s_};
  const mjModel& m = robot_.model();
  all.insert(all.end(), start_control_.begin(), start_control_.end());
  all.insert(all.end(), start_qpos_.begin(), start_qpos_.end());
  all.insert(all.end(), start_limit_.begin(), start_limit_.end());
  append_pose(all, start_site_);
  for (int a = 0; a < m.nu; ++a) {
    all.push_back(m.actuator_forcelimited[a]);
    all.insert(all.end(), {m.actuator_forcerange[2 * a], m.actuator_forcerange[2 * a + 1]});
  }
  return all;
}

void Controller::restore(const std::vector<double>& state) {
  mjModel& m = robot_.model();
  if (state.size() != this->state().size()) throw DataError("a saved state is of another model");
  auto at = state.begin();
  step_ = static_cast<std::size_t>(*at++);
  started_s_ = *at++;
  for (double& value : start_control_) value = *at++;
  for (double& value : start_qpos_) value = *at++;
  for (double& value : start_limit_) value = *at++;
  start_site_ = pose_of(&*at);
  at += 16;
  for (int a = 0; a < m.nu; ++a) {
    m.actuator_forcelimited[a] = static_cast<mjtByte>(*at++);
    m.actuator_forcerange[2 * a] = *at++;
    m.actuator_forcerange[2 * a + 1] = *at++;
  }
}

}  // namespace tacipc
