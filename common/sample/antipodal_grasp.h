// Grasps of a closed object by two parallel fronts, drawn at random on its surface.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "common/config/config.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// The key `rotation_xyzw`: a unit quaternion, scalar last; none where it is absent.
Eigen::Quaterniond read_rotation(ConfigReader& in);

/// How an object is held: turned so that the fingers close along x of the world, z up, and where.
struct GraspPose {
  Matrix3 world_from_object = Matrix3::Identity();
  Vector3 grip_m = Vector3::Zero();  // from the centre of mass, in the object's axes
  std::optional<double> width_m;     // of a drawn one: distance of the two contact points,
  std::optional<double> patch_m;     // and how wide a patch was asked for in the end

  /// Distance of the centre of mass from the line on which the fingers press.
  double lever_m() const;
};

/// `fingers.draw` of a grasp: limits of the hand, and which of the grasps found is taken.
struct GraspDraw {
  std::uint64_t seed = 1;
  int best_of = 1;  // the smallest lever of so many
  bool upright =
      false;  // z of the object looks up as far as the grasp lets it, else it is turned about the grasp's line
  double least_width_m = 0.5e-3, most_width_m = 80e-3;
  double patch_m = 5e-3;    // across, halved three times and then left out as long as no place has one
  double depth_m = 0.5e-3;  // that the fronts may be pressed in to reach a patch

  static GraspDraw read(ConfigReader& in);
  /// All keys but the seed.
  static GraspDraw read_limits(ConfigReader& in);
};

/// A contact point p is drawn on the surface by area; the other, q, is the last point of the object on the line from p
/// against the outward normal there. Kept if
/// - both normals are within atan(friction) of the line pq (antipodal: forces along it lie in both friction cones),
/// - |pq| is within the limits of the hand,
/// - the surface is at most `depth_m` behind p (and q) on the whole rim of the patch around it, and
/// - nothing of the object stands out by more than `depth_m` before p (and q) where the front is, which faces it with
///   its middle there; a dome counts as flat. Only the fronts count: the rest of a hand has no shape.
/// A function of its arguments alone. \pre the object is closed and looks outwards
/// \throw DataError that says how many places were ruled out by what, if none was kept
GraspPose draw_grasp(const TriangleMesh& object, const Vector3& center_of_mass_m, const GelShape& front,
                     double friction, const GraspDraw& draw);

}  // namespace tacipc
