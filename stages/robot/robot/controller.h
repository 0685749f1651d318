// Controller: turns the steps of a robot's task into actuator controls, time step by time step.
#pragma once

#include <memory>
#include <vector>

#include "stages/robot/robot/mjcf_model.h"

namespace tacipc {

/// Carries out the steps of a task by setting actuator controls. A site of the robot follows its path by inverse
/// kinematics (damped least squares) over the joints that position servos drive.
class Controller {
 public:
  /// Starts at the first step.
  /// \throw UsageError if a step names an actuator or site that the model lacks
  Controller(const TaskSpec& task, RobotModel& robot);

  /// Resumes from a state that state() returned earlier.
  /// \throw DataError if the state's size does not fit the model
  void restore(const std::vector<double>& state);
  /// Returns everything that later steps depend on: index and start of the current step, force limits of all actuators.
  std::vector<double> state() const;

  /// Sets the controls for the current time of the model's data, and begins further steps as earlier ones end.
  /// \param pads magnitude of the force on each pad, N
  /// \throw DataError if a site cannot reach its target
  void act(const std::vector<double>& pads);
  /// Returns whether all steps are over.
  bool done() const { return step_ >= task_.steps.size(); }
  /// Returns the index of the current step; the number of steps once all are over.
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
  std::vector<Servo> servos_;                // position servos that each drive a single joint
  std::unique_ptr<mjData, ModelFree> plan_;  // scratch data for inverse kinematics
  // State at the beginning of the current step.
  std::size_t step_ = 0;
  double started_s_ = 0.0;
  std::vector<double> start_control_, start_qpos_, start_limit_;  // start_limit_: largest force, 0 if unlimited
  Matrix4 start_site_ = Matrix4::Identity();
};

}  // namespace tacipc
