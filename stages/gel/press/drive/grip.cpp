#include "stages/gel/press/drive/grip.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/sample/placement.h"

namespace tacipc {
namespace {

void check_settings(const Sensor& sensor, const TriangleMesh& object, const PressConfig& config) {
  require_rigid_mount(sensor);
  if (config.augmented_lagrangian)
    throw UsageError(
        "constraints: augmented_lagrangian holds gels and object to their poses; a grasp needs elimination");
  if (config.gravity_m_s2 != Vector3::Zero())
    throw UsageError(
        "gravity_m_s2 is along the axes of one gel; a grasp has it in the sample, in fingers.gravity_m_s2");
  if (config.mass_damping_per_s > 0.0) throw UsageError("damping.mass_per_s would hold back fingers that move");
  if (!config.friction) log_warning("the press file has no friction: nothing can be lifted by it");
  if (!check_object(object, config))
    throw DataError(
        "the object is not closed: its mass and inertia are those of the volume it encloses; close the mesh, or "
        "WRAP=yes");
}

/// Axes of a finger's frame S in the world: z of S is x of the world for the left finger and −x for the right one; y,
/// which is down in images, is down in the world.
Matrix3 world_from_finger(int side) {
  const Vector3 z = side == 0 ? Vector3::UnitX() : Vector3(-Vector3::UnitX()), y = -Vector3::UnitZ();
  Matrix3 R;
  R << y.cross(z), y, z;
  return R;
}

/// Pose of a finger at a gap from the object. \param object_m vertices of the object in the world
Matrix4 beside(const TetMesh& gel, const TriangleMesh& object, const Positions& object_m, int side, double gap_m) {
  const Eigen::RowVector3d low = gel.positions.colwise().minCoeff(), high = gel.positions.colwise().maxCoeff();
  const Matrix3 R = world_from_finger(side);
  const Positions seen = object_m * R;  // object vertices in the axes of the finger
  // Extent of the object towards the finger, within the area of the gel.
  double reach = -std::numeric_limits<double>::infinity();
  for (Eigen::Index t = 0; t < object.num_triangles(); ++t) {
    Eigen::AlignedBox3d box;
    for (int k = 0; k < 3; ++k) box.extend(Vector3(seen.row(object.triangles(t, k))));
    const bool within =
        box.min().x() <= high.x() && box.max().x() >= low.x() && box.min().y() <= high.y() && box.max().y() >= low.y();
    if (within) reach = std::max(reach, -box.min().z());
  }
  if (!std::isfinite(reach))
    throw DataError(
        "there is nothing of the object between the fingers at the grip point: fingers.grip_mm (GRIP) is measured "
        "from the centre of mass, in the object's axes");
  Matrix4 pose = Matrix4::Identity();
  pose.topLeftCorner<3, 3>() = R;
  pose.topRightCorner<3, 1>() = -R.col(2) * (reach + gap_m);
  return pose.array() + 0.0;  // turns −0 into 0
}

}  // namespace

Grip make_grip(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
               const GraspSpec& spec, Grasp& grasp) {
  check_settings(sensor, object, config);
  const MassProperties mass = spec.mass_of(object);
  grasp.friction = config.coefficient_of_friction();
  AffineBody affine = make_affine_body(object.positions, object.triangles,
                                       spec.density_of(mass.volume_m3, grasp.friction), spec.center_shift_m);
  grasp.gravity_m_s2 = spec.gravity_m_s2;
  grasp.center_shift_m = spec.center_shift_m;
  grasp.mass_kg = affine.mass_kg;
  grasp.weight_n = affine.mass_kg * spec.gravity_m_s2.norm();
  grasp.center_of_mass_m = mass.center_m;
  grasp.pose = spec.pose_of(object, mass, sensor.gel, grasp.friction);
  Matrix4 world_from_object = Matrix4::Identity();
  world_from_object.topLeftCorner<3, 3>() = grasp.pose.world_from_object;
  world_from_object.topRightCorner<3, 1>() = -grasp.pose.world_from_object * grasp.grip_point();

  Grip grip{.bodies = {}, .start_gap_m = spec.start_gap_m.value_or(scales_of(config, sensor, gel).start_gap_m)};
  const Positions at = transformed(world_from_object, object.positions);
  for (const int side : {0, 1})
    grip.bodies.push_back({.name = side == 0 ? "left" : "right",
                           .tets = gel,
                           .material = sensor.material,
                           .start = beside(gel, object, at, side, grip.start_gap_m)});
  grip.start_width_m = grip.bodies[1].start(0, 3) - grip.bodies[0].start(0, 3);
  grip.bodies.push_back({.name = "object", .surface = object, .start = world_from_object, .affine = std::move(affine)});
  return grip;
}

}  // namespace tacipc
