// Stands for the press where robot and press are coupled: gels that are springs along their axis, against one object
// that is fixed or moves along one line.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "stages/robot/robot/run.h"

namespace tacipc {

/// A plate of a half thickness between gels that look at it along ± `axis`: depth d = (x − c) · n + half, with x the
/// origin of S, n its z and c the middle of the plate; on the plate n k dᵖ, on the gel the opposite.
struct SpringPress {
  double stiffness = 0.0;  // k, N/mᵖ
  double power = 1.0;
  double half_m = 0.0;
  double mass_kg = 0.0;  // 0: fixed
  Vector3 axis = Vector3::UnitX();
  Vector3 gravity_m_s2 = Vector3::Zero();
  double sign = 1.0;                   // −1: answers with the wrong sign
  Vector3 center_m = Vector3::Zero();  // where the window begins
  Vector3 velocity_m_s = Vector3::Zero();

  Vector3 force_on_gel(const Matrix4& pose, const Vector3& center) const {
    const Vector3 n = pose.block<3, 1>(0, 2);
    return -n * stiffness * std::pow(std::max(0.0, depth(pose, center)), power);
  }
  double depth(const Matrix4& pose, const Vector3& center) const {
    const Vector3 n = pose.block<3, 1>(0, 2);
    return (pose.topRightCorner<3, 1>() - center).dot(n) + half_m;
  }

  /// m (v₁ − v₀)/h = Σ forces at c₀ + h v₁: implicit Euler, by bisection on its monotone residual.
  void step(const std::vector<Matrix4>& pads, double h) {
    if (mass_kg == 0.0) return;
    const auto excess = [&](double v) {
      const Vector3 there = center_m + h * v * axis;
      double sum = -mass_kg * (v - velocity_m_s.dot(axis)) / h + mass_kg * gravity_m_s2.dot(axis);
      for (const Matrix4& pad : pads) sum -= force_on_gel(pad, there).dot(axis);
      return sum;
    };
    double low = -10.0, high = 10.0;
    for (int i = 0; i < 200 && low < high; ++i) (excess(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
    velocity_m_s = 0.5 * (low + high) * axis;
    center_m += h * velocity_m_s;
  }

  PadAnswer answer(const Matrix4& pose) const {
    PadAnswer pad{.world_from_gel = pose};
    pad.wrench.force_n = sign * force_on_gel(pose, center_m);
    pad.gap_m = -depth(pose, center_m);
    pad.carried = mass_kg > 0.0 ? 0 : -1;
    return pad;
  }

  Matrix4 object_pose() const {
    Matrix4 pose = Matrix4::Identity();
    pose.topRightCorner<3, 1>() = center_m;
    return pose;
  }

  /// Goes through the frames of a try from `first` on; where it was at the last one it stays.
  WindowAnswers answers(const TaskSpec& task, const RobotRun& tried, std::size_t first) {
    WindowAnswers all;
    for (const ObjectSpec& object : task.objects)
      all.inertia_n_m.push_back(object.fixed ? 0.0 : mass_kg / (task.frame_s * task.frame_s));
    for (std::size_t f = first; f < tried.frames.size(); ++f) {
      if (f > first) step(tried.frames[f].pad_pose, task.frame_s);
      auto& of_frame = all.frames.emplace_back();
      for (const Matrix4& pose : tried.frames[f].pad_pose) of_frame.push_back(answer(pose));
      all.floats.emplace_back(task.objects.size(), mass_kg > 0.0);
      auto& objects = all.objects.emplace_back();
      for (const ObjectSpec& object : task.objects) {
        if (!object.fixed) objects.push_back(object_pose());
      }
    }
    return all;
  }
};

/// A whole coupled run as pipelines/sample/couple.sh makes it.
struct CoupledRun {
  RobotRun run;
  std::vector<std::vector<PadAnswer>> answers;  // accepted, per frame
  std::vector<Vector3> object_velocity_m_s;     // after each window
  std::vector<int> tries;                       // of each window
  std::vector<double> residuals;                // relative, that each window ended with
};

/// Windows until the task is over or one does not come below `tolerance` in `most` tries.
inline CoupledRun couple(const TaskSpec& task, RobotModel& robot, SpringPress press, double tolerance, int most) {
  CoupledRun coupled;
  std::optional<RobotRun> before;
  std::vector<Matrix4> objects;
  if (press.mass_kg > 0.0) objects.push_back(press.object_pose());
  double stiffness = task.coupling.stiffness_n_m;
  std::vector<PadAnswer> at_start;
  for (std::size_t p = 0; p < task.pads.size(); ++p) at_start.push_back(press.answer(robot.pad_pose(p)));
  coupled.answers.push_back(at_start);
  while (!before || !before->finished) {
    const std::size_t first = before ? before->frames.size() - 1 : 0;
    std::optional<WindowAnswers> answers;
    for (int k = 1;; ++k) {
      const RobotRun tried = run_window(task, robot,
                                        {.before = before ? &*before : nullptr,
                                         .answers = answers ? &*answers : nullptr,
                                         .at_start = at_start,
                                         .objects_at_start = objects,
                                         .frames = task.coupling.window_frames,
                                         .stiffness_n_m = stiffness});
      SpringPress there = press;
      WindowAnswers next = there.answers(task, tried, first);
      const TryJudgement judged = judge_try(
          task, tried, first, answers ? answers->frames : std::vector<std::vector<PadAnswer>>{}, stiffness, next);
      const bool agreed = judged.residual.relative <= tolerance;
      if (agreed || k == most) {
        coupled.tries.push_back(k);
        coupled.residuals.push_back(judged.residual.relative);
        coupled.object_velocity_m_s.push_back(there.velocity_m_s);
        coupled.run = tried;
        if (!agreed) return coupled;
        coupled.answers.insert(coupled.answers.end(), next.frames.begin() + 1, next.frames.end());
        at_start = next.frames.back();
        objects = next.objects.back();
        before = tried;
        press = there;
        break;
      }
      stiffness = judged.stiffness_n_m;
      answers = std::move(next);
    }
  }
  return coupled;
}

}  // namespace tacipc
