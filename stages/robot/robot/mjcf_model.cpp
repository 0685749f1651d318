#include "stages/robot/robot/mjcf_model.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numbers>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/mesh/mass_properties.h"
#include "common/sample/rigid_way.h"

namespace tacipc {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

const char* kind_name(mjtObj kind) {
  switch (kind) {
    case mjOBJ_GEOM: return "geom";
    case mjOBJ_SITE: return "site";
    case mjOBJ_ACTUATOR: return "actuator";
    case mjOBJ_JOINT: return "joint";
    default: return "body";
  }
}

int count_of(const mjModel& m, mjtObj kind) {
  switch (kind) {
    case mjOBJ_GEOM: return m.ngeom;
    case mjOBJ_SITE: return m.nsite;
    case mjOBJ_ACTUATOR: return m.nu;
    case mjOBJ_JOINT: return m.njnt;
    default: return m.nbody;
  }
}

}  // namespace

Matrix4 pose_from(const mjtNum* position, const mjtNum* rotation) {
  Matrix4 pose = Matrix4::Identity();
  pose.topLeftCorner<3, 3>() = Eigen::Map<const RowMajor3>(rotation);
  pose.topRightCorner<3, 1>() = Eigen::Map<const Vector3>(position);
  return pose;
}

Eigen::Quaterniond quaternion_from(const mjtNum* wxyz) { return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]}; }

void to_wxyz(const Matrix3& rotation, mjtNum* wxyz) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  wxyz[0] = q.w(), wxyz[1] = q.x(), wxyz[2] = q.y(), wxyz[3] = q.z();
}

bool is_servo(const mjModel& m, int a) {
  const int joint = m.actuator_trnid[2 * a];
  // force = gain × control + bias₁ × length with bias₁ = −gain.
  return m.actuator_trntype[a] == mjTRN_JOINT && m.actuator_gaintype[a] == mjGAIN_FIXED &&
         m.actuator_biastype[a] == mjBIAS_AFFINE && m.actuator_gainprm[mjNGAIN * a] > 0.0 &&
         m.actuator_biasprm[mjNBIAS * a + 1] == -m.actuator_gainprm[mjNGAIN * a] && m.actuator_gear[6 * a] == 1.0 &&
         (m.jnt_type[joint] == mjJNT_HINGE || m.jnt_type[joint] == mjJNT_SLIDE);
}

RobotModel::RobotModel(const TaskSpec& task, const std::vector<TaskObject>& objects, bool coupled) : task_(task) {
  mju_user_error = [](const char* text) { throw SolverError("MuJoCo: {}", text); };
  mju_user_warning = [](const char* text) { log_warning("MuJoCo: {}", text); };
  std::array<char, 1000> reason{};
  model_.reset(mj_loadXML(task.model.c_str(), nullptr, reason.data(), static_cast<int>(reason.size())));
  if (!model_) throw DataError("{}: {}", task.model.string(), reason.data());
  mjModel& m = *model_;
  if (m.opt.integrator == mjINT_RK4)
    throw UsageError(fmt::format("{}: integrator RK4 does not let forces in between its stages; take Euler or implicit",
                                 task.model.string()));
  for (const PadSpec& pad : task.pads) {
    pad_geoms_.push_back(id(mjOBJ_GEOM, pad.geom));
    if (m.geom_type[pad_geoms_.back()] == mjGEOM_MESH)
      throw UsageError(
          fmt::format("pad {}: geom {} is a mesh, whose frame MuJoCo moves to its centre and principal axes; "
                      "take a box or a cylinder",
                      pad.name, pad.geom));
  }
  for (std::size_t i = 0; i < task.objects.size(); ++i) {
    const ObjectSpec& spec = task.objects[i];
    const int body = id(mjOBJ_BODY, spec.name);
    object_bodies_.push_back(body);
    const bool is_free = m.body_jntnum[body] == 1 && m.jnt_type[m.body_jntadr[body]] == mjJNT_FREE;
    if (spec.fixed ? m.body_weldid[body] != 0 : !is_free)
      throw UsageError(fmt::format("{}: body {} is to be {}", task.model.string(), spec.name,
                                   spec.fixed ? "fixed to the world" : "rigid, so it needs a joint of type free"));
    if (!spec.fixed) give_mass(body, objects[i]);
  }
  data_.reset(mj_makeData(model_.get()));
  for (std::size_t i = 0; i < task.objects.size(); ++i) place(task.objects[i], object_bodies_[i]);
  if (coupled) {
    std::vector<int> silent = pad_geoms_;
    for (std::size_t i = 0; i < task.objects.size(); ++i) {
      if (task.objects[i].fixed) continue;
      for (int g = 0; g < m.body_geomnum[object_bodies_[i]]; ++g)
        silent.push_back(m.body_geomadr[object_bodies_[i]] + g);
    }
    for (const int geom : silent) m.geom_contype[geom] = m.geom_conaffinity[geom] = 0;
    for (int pair = 0; pair < m.npair; ++pair) {
      for (const int geom : {m.pair_geom1[pair], m.pair_geom2[pair]}) {
        if (std::find(silent.begin(), silent.end(), geom) != silent.end())
          throw UsageError(
              fmt::format("{}: contact pair of {}: what a gel or a rigid object touches is the press's; "
                          "leave the pair out",
                          task.model.string(), name(mjOBJ_GEOM, geom)));
      }
    }
  }
  // Use the home keyframe, if there is one, else zero for all joints; objects stay where the task puts them.
  mj_setConst(model_.get(), data_.get());
  mj_resetData(model_.get(), data_.get());
  if (m.nkey > 0) {
    mj_resetDataKeyframe(model_.get(), data_.get(), 0);
    data_->time = 0.0;
    for (std::size_t i = 0; i < task.objects.size(); ++i) {
      if (task.objects[i].fixed) continue;
      const int at = m.jnt_qposadr[m.body_jntadr[object_bodies_[i]]];
      for (int k = 0; k < 7; ++k) data_->qpos[at + k] = m.qpos0[at + k];
    }
  }
  for (const auto& [name, value] : task.start) {
    const int joint = id(mjOBJ_JOINT, name);
    const bool hinge = m.jnt_type[joint] == mjJNT_HINGE;
    if (!hinge && m.jnt_type[joint] != mjJNT_SLIDE)
      throw UsageError(fmt::format("start: joint {} is neither a hinge nor a slide", name));
    const double q = value * (hinge ? std::numbers::pi / 180.0 : 1e-3);
    data_->qpos[m.jnt_qposadr[joint]] = q;
    bool held = false;
    for (int a = 0; a < m.nu; ++a) {
      if (!is_servo(m, a) || m.actuator_trnid[2 * a] != joint) continue;
      data_->ctrl[a] = q;
      held = true;
    }
    if (!held) log_warning("start: no position servo holds joint {}: it may leave", name);
  }
  mj_forward(model_.get(), data_.get());
}

void RobotModel::give_mass(int body, const TaskObject& object) {
  mjModel& m = *model_;
  const MassProperties mass = mass_properties(object.mesh.positions, object.mesh.triangles);
  const Eigen::SelfAdjointEigenSolver<Matrix3> principal(inertia_tensor(object.mass_kg, mass.second_moment_m2));
  Matrix3 axes = principal.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(0) *= -1.0;
  m.body_mass[body] = object.mass_kg;
  for (int k = 0; k < 3; ++k) {
    m.body_inertia[3 * body + k] = principal.eigenvalues()[k];
    m.body_ipos[3 * body + k] = mass.center_m[k];
  }
  to_wxyz(axes, m.body_iquat + 4 * body);
  // Reset shortcuts that MuJoCo derived from the frames of the model's own masses.
  m.body_sameframe[body] = m.body_simple[body] = 0;
  for (int k = 0; k < m.body_geomnum[body]; ++k) m.geom_sameframe[m.body_geomadr[body] + k] = 0;
  for (int k = 0; k < m.nsite; ++k) {
    if (m.site_bodyid[k] == body) m.site_sameframe[k] = 0;
  }
  const int first = m.jnt_dofadr[m.body_jntadr[body]];
  for (int k = 0; k < 6; ++k) m.dof_simplenum[first + k] = 0;
  // Earlier degrees of freedom count those that follow.
  for (int k = first - 1; k >= 0 && m.dof_simplenum[k] > 0; --k) m.dof_simplenum[k] = m.dof_simplenum[k + 1] + 1;
}

void RobotModel::place(const ObjectSpec& spec, int body) {
  if (!spec.at_m && !spec.turn_rad) return;
  mjModel& m = *model_;
  const int at = spec.fixed ? 0 : m.jnt_qposadr[m.body_jntadr[body]];
  mjtNum* position = spec.fixed ? m.body_pos + 3 * body : m.qpos0 + at;
  mjtNum* rotation = spec.fixed ? m.body_quat + 4 * body : m.qpos0 + at + 3;
  const auto pose_of = [](const mjtNum* p, const mjtNum* q) {
    return Eigen::Translation3d(p[0], p[1], p[2]) * quaternion_from(q).normalized();
  };
  // A fixed body may be a child of other fixed bodies.
  Eigen::Isometry3d parent = Eigen::Isometry3d::Identity();
  for (int up = m.body_parentid[body]; spec.fixed && up > 0; up = m.body_parentid[up])
    parent = pose_of(m.body_pos + 3 * up, m.body_quat + 4 * up) * parent;
  Eigen::Isometry3d pose = parent * pose_of(position, rotation);
  if (spec.at_m) pose.translation() = *spec.at_m;
  if (spec.turn_rad) pose.linear() = RigidWay{.turn_rad = *spec.turn_rad}.turn();
  pose = parent.inverse() * pose;
  for (int k = 0; k < 3; ++k) position[k] = pose.translation()[k];
  to_wxyz(pose.linear(), rotation);
}

int RobotModel::id(mjtObj kind, const std::string& name) const {
  const int found = mj_name2id(model_.get(), kind, name.c_str());
  if (found >= 0) return found;
  std::vector<std::string> names;
  for (int i = 0; i < count_of(*model_, kind); ++i) {
    if (const char* other = mj_id2name(model_.get(), kind, i); other && *other) names.emplace_back(other);
  }
  throw UsageError(fmt::format("{}: has no {} '{}'; it has {}", task_.model.string(), kind_name(kind), name,
                               names.empty() ? "none with a name" : fmt::format("{}", fmt::join(names, ", "))));
}

std::string RobotModel::name(mjtObj kind, int id) const {
  const char* name = mj_id2name(model_.get(), kind, id);
  return name && *name ? name : fmt::format("{}_{}", kind_name(kind), id);
}

Matrix4 RobotModel::body_pose(int body) const { return pose_from(data_->xpos + 3 * body, data_->xmat + 9 * body); }

Twist RobotModel::body_twist(int body) const {
  std::array<mjtNum, 6> twist{};
  // Velocity at the frame's origin; the angular velocity comes first.
  mj_objectVelocity(model_.get(), data_.get(), mjOBJ_XBODY, body, twist.data(), 0);
  return {Vector3(twist[3], twist[4], twist[5]), Vector3(twist[0], twist[1], twist[2])};
}

Matrix4 RobotModel::pad_pose(std::size_t pad) const {
  const int geom = pad_geoms_[pad];
  return pose_from(data_->geom_xpos + 3 * geom, data_->geom_xmat + 9 * geom) * task_.pads[pad].geom_from_gel;
}

void RobotModel::put_object(std::size_t object, const Matrix4& world_from_body) {
  const int joint = model_->body_jntadr[object_bodies_[object]];
  mjtNum* q = data_->qpos + model_->jnt_qposadr[joint];
  for (int k = 0; k < 3; ++k) q[k] = world_from_body(k, 3);
  to_wxyz(world_from_body.topLeftCorner<3, 3>(), q + 3);
  for (int k = 0; k < 6; ++k) data_->qvel[model_->jnt_dofadr[joint] + k] = 0.0;
}

void RobotModel::push_pad(std::size_t pad, const Wrench& wrench) {
  const int body = model_->geom_bodyid[pad_geoms_[pad]];
  const Vector3 arm = pad_pose(pad).topRightCorner<3, 1>() - Eigen::Map<const Vector3>(data_->xipos + 3 * body);
  const Vector3 torque = wrench.torque_n_m + arm.cross(wrench.force_n);
  for (int k = 0; k < 3; ++k) {
    data_->xfrc_applied[6 * body + k] += wrench.force_n[k];
    data_->xfrc_applied[6 * body + 3 + k] += torque[k];
  }
}

void RobotModel::forget_pushes() {
  mju_zero(data_->xfrc_applied, 6 * model_->nbody);
  // Cancel the weight, so that objects stay where they are put.
  const bool weightless = (model_->opt.disableflags & mjDSBL_GRAVITY) != 0;
  for (std::size_t i = 0; i < task_.objects.size() && !weightless; ++i) {
    if (task_.objects[i].fixed) continue;
    const int body = object_bodies_[i];
    for (int k = 0; k < 3; ++k) data_->xfrc_applied[6 * body + k] = -model_->body_mass[body] * model_->opt.gravity[k];
  }
}

Wrench RobotModel::pad_contact(std::size_t pad) const {
  const Vector3 origin = pad_pose(pad).topRightCorner<3, 1>();
  Wrench sum{Vector3::Zero(), Vector3::Zero()};
  for (int c = 0; c < data_->ncon; ++c) {
    const mjContact& contact = data_->contact[c];
    if (contact.geom1 != pad_geoms_[pad] && contact.geom2 != pad_geoms_[pad]) continue;
    std::array<mjtNum, 6> f{};
    mj_contactForce(model_.get(), data_.get(), c, f.data());
    // Rows of the frame are the contact's axes; the force acts on the second geom.
    const Eigen::Map<const RowMajor3> axes(contact.frame);
    const double sign = contact.geom2 == pad_geoms_[pad] ? 1.0 : -1.0;
    const Vector3 force = sign * axes.transpose() * Vector3(f[0], f[1], f[2]),
                  torque = sign * axes.transpose() * Vector3(f[3], f[4], f[5]);
    sum.force_n += force;
    sum.torque_n_m += torque + (Eigen::Map<const Vector3>(contact.pos) - origin).cross(force);
  }
  return sum;
}

void RobotModel::check(double time_s) const {
  for (const mjtWarning kind : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC}) {
    if (data_->warning[kind].number > 0)
      throw DataError("{}: the motion became unstable at {:.3f} s: a smaller timestep, or softer actuators",
                      task_.model.string(), time_s);
  }
}

}  // namespace tacipc
