// What a robot is told in each of its time steps.
#pragma once

#include <memory>
#include <vector>

#include "stages/robot/robot/mjcf_model.h"

namespace tacipc {

/// Goes through the steps of a task: sets the controls of actuators. Points of the robot are moved by inverse
/// kinematics (damped least squares) over the joints that position servos drive.
class Controller {
 public:
  /// \throw UsageError if a step names what the model does not have
  Controller(const TaskSpec& task, RobotModel& robot);

  /// At the start, or what state() was at a later time.
  void restore(const std::vector<double>& state);
  std::vector<double> state() const;

  /// Sets the controls for the time of the model's data. \param pads forces on the pads, N, as they are felt now
  void act(const std::vector<double>& pads);
  /// Whether all steps are over.
  bool done() const { return step_ >= task_.steps.size(); }
  std::size_t step() const { return step_; }

 private:
  struct Servo {
    int actuator, joint;
  };
  void begin_step(double time_s);
  void set_limits(const TaskStep& step, double part);
  bool over(const TaskStep& step, const std::vector<double>& pads) const;
  void follow(const TaskStep& step, double part, double elapsed_s);
  Matrix4 site_pose(const mjData& data, int site) const;
  void set_servos(mjData& data) const;

  const TaskSpec& task_;
  RobotModel& robot_;
  std::vector<Servo> servos_;  // position servos on single joints
  std::unique_ptr<mjData, ModelFree> plan_;
  // What a step goes on from.
  std::size_t step_ = 0;
  double started_s_ = 0.0;
  std::vector<double> start_control_, start_qpos_, start_limit_;  // of forces: 0 where there is none
  Matrix4 start_site_ = Matrix4::Identity();
};

}  // namespace tacipc
