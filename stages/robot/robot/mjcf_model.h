// A model and its state in MuJoCo, with what a task says of it. Versions 2.2 to 4 of the library are meant.
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

struct ModelFree {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};

/// What the press has of an object.
struct TaskObject {
  TriangleMesh mesh;  // its own frame, m: that of the model's body
  double mass_kg = 0.0;
};

class RobotModel {
 public:
  /// Loads the model; objects get mass, centre and inertia of their meshes, and the places that the task gives them.
  /// \param coupled the gels are the press's: its pads and rigid objects touch nothing here, and objects stay where
  /// they are put
  /// \throw UsageError naming what the model does not have, or has in another way; DataError if MuJoCo refuses it
  RobotModel(const TaskSpec& task, const std::vector<TaskObject>& objects, bool coupled);

  const mjModel& model() const { return *model_; }
  mjModel& model() { return *model_; }
  mjData& data() { return *data_; }
  const mjData& data() const { return *data_; }
  std::unique_ptr<mjData, ModelFree> make_data() const {
    return std::unique_ptr<mjData, ModelFree>(mj_makeData(model_.get()));
  }

  /// Number of a named part. \throw UsageError if there is none, naming those there are
  int id(mjtObj kind, const std::string& name) const;
  std::string name(mjtObj kind, int id) const;

  Matrix4 body_pose(int body) const;
  Twist body_twist(int body) const;
  Matrix4 pad_pose(std::size_t pad) const;
  int object_body(std::size_t object) const { return object_bodies_[object]; }
  /// Puts a rigid object where it is, at rest.
  void put_object(std::size_t object, const Matrix4& world_from_body);

  /// Adds a wrench about the origin of a pad's S, along axes of the world, to what acts in the next step.
  void push_pad(std::size_t pad, const Wrench& wrench);
  void forget_pushes();
  /// Σ of the contacts of a pad's geom, about the origin of its S, along axes of the world: of the last step.
  Wrench pad_contact(std::size_t pad) const;

  /// \throw DataError if the last step, which began at this time, became unstable; MuJoCo then begins anew
  void check(double time_s) const;

 private:
  void give_mass(int body, const TaskObject& object);
  void place(const ObjectSpec& spec, int body);

  const TaskSpec& task_;
  std::unique_ptr<mjModel, ModelFree> model_;
  std::unique_ptr<mjData, ModelFree> data_;
  std::vector<int> pad_geoms_, object_bodies_;
};

/// Whether an actuator is a servo that brings a single joint to its control.
bool is_servo(const mjModel& model, int actuator);

/// MuJoCo's row-major 3 × 3 and w, x, y, z as ours, and back.
Matrix4 pose_from(const mjtNum* position, const mjtNum* rotation);
Eigen::Quaterniond quaternion_from(const mjtNum* wxyz);
void to_wxyz(const Matrix3& rotation, mjtNum* wxyz);

}  // namespace tacipc
