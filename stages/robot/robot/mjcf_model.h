// RobotModel: a MuJoCo model and its state, set up for a task. Supports MuJoCo 2.2 to 4.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/types.h"
#include "common/base/wrench.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/press_folder.h"
#include "stages/robot/robot/task_spec.h"

namespace tacipc {

/// Deleter of MuJoCo's models and data, for std::unique_ptr.
struct ModelFree {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};

/// Mesh and mass of one object, as the press uses them.
struct TaskObject {
  TriangleMesh mesh;     // surface in the frame of the model's body, m
  double mass_kg = 0.0;  // 0 if the object is fixed
};

/// A MuJoCo model with its current state.
class RobotModel {
 public:
  /// Loads the model. Rigid objects get mass, centre of mass and inertia from their meshes; all objects get the poses
  /// that the task gives.
  /// \param coupled true: the press computes the contacts of pads and rigid objects, so that MuJoCo ignores them, and
  /// rigid objects stay at the pose that put_object() sets
  /// \throw UsageError if the model lacks a part that the task names, or the part is of the wrong kind
  /// \throw DataError if MuJoCo refuses the model
  RobotModel(const TaskSpec& task, const std::vector<TaskObject>& objects, bool coupled);

  /// Return MuJoCo's model and state.
  const mjModel& model() const { return *model_; }
  mjModel& model() { return *model_; }
  mjData& data() { return *data_; }
  const mjData& data() const { return *data_; }
  /// Makes a second state of the same model.
  std::unique_ptr<mjData, ModelFree> make_data() const {
    return std::unique_ptr<mjData, ModelFree>(mj_makeData(model_.get()));
  }

  /// Returns the index of a named part.
  /// \throw UsageError if the model has no such part; the message lists the names there are
  int id(mjtObj kind, const std::string& name) const;
  /// Returns the name of a part; kind and index, as in "geom_3", if it has none.
  std::string name(mjtObj kind, int id) const;

  /// Returns world_from_body.
  Matrix4 body_pose(int body) const;
  /// Returns the velocity of the body's origin and its angular velocity, along the world's axes.
  Twist body_twist(int body) const;
  /// Returns world_from_gel: the pose of a pad's frame S.
  Matrix4 pad_pose(std::size_t pad) const;
  /// Returns the index of the body of a task's object.
  int object_body(std::size_t object) const { return object_bodies_[object]; }
  /// Sets the pose of a rigid object and its velocity to zero.
  void put_object(std::size_t object, const Matrix4& world_from_body);

  /// Adds a wrench on a pad to the external forces of the next step.
  /// \param wrench along the world's axes, about the origin of the pad's S
  void push_pad(std::size_t pad, const Wrench& wrench);
  /// Removes all external forces, and cancels the weight of rigid objects.
  void forget_pushes();
  /// Returns the contact wrench on a pad in the last step, along the world's axes, about the origin of the pad's S.
  Wrench pad_contact(std::size_t pad) const;

  /// Checks that the last step was stable. MuJoCo resets its state if it was not.
  /// \param time_s time at which the step began
  /// \throw DataError if the step became unstable
  void check(double time_s) const;

 private:
  void give_mass(int body, const TaskObject& object);
  void place(const ObjectSpec& spec, int body);

  const TaskSpec& task_;
  std::unique_ptr<mjModel, ModelFree> model_;
  std::unique_ptr<mjData, ModelFree> data_;
  std::vector<int> pad_geoms_, object_bodies_;
};

/// Returns whether an actuator is a position servo of a single joint.
bool is_servo(const mjModel& model, int actuator);

/// Converts MuJoCo's poses (position and row-major 3 × 3 rotation) and quaternions (w, x, y, z) to Eigen and back.
Matrix4 pose_from(const mjtNum* position, const mjtNum* rotation);
Eigen::Quaterniond quaternion_from(const mjtNum* wxyz);
void to_wxyz(const Matrix3& rotation, mjtNum* wxyz);

}  // namespace tacipc
