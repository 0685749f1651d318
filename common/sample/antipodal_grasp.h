// Draws grasps of a closed object by two parallel gel fronts at random on the object's surface.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "common/config/config.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Reads the key `rotation_xyzw`: a unit quaternion, scalar last. Identity if the key is absent.
Eigen::Quaterniond read_rotation(ConfigReader& in);

/// Pose of a gripped object: its rotation, with the fingers closing along x of the world and z up, and the grip point.
struct GraspPose {
  Matrix3 world_from_object = Matrix3::Identity();
  Vector3 grip_m = Vector3::Zero();  // grip point relative to the centre of mass, in the object's axes
  std::optional<double> width_m;     // distance of the two contact points; only for a drawn grasp
  std::optional<double> patch_m;     // width of the patch that the draw found in the end; only for a drawn grasp

  /// Returns the distance of the centre of mass from the line along which the fingers press, m.
  double lever_m() const;
};

/// Settings of `fingers.draw` in a grasp file: limits of the hand, and the choice among the grasps found.
struct GraspDraw {
  std::uint64_t seed = 1;
  int best_of = 1;       // number of grasps found, of which the one with the smallest lever is taken
  bool upright = false;  // true: z points up as far as the grasp line allows; false: a random angle about that line
  double least_width_m = 0.5e-3, most_width_m = 80e-3;
  double patch_m = 5e-3;    // width of the patch; if no place has one, it is halved up to three times, then ignored
  double depth_m = 0.5e-3;  // largest depth to which the fronts may be pressed in to reach a patch

  /// Reads all keys.
  static GraspDraw read(ConfigReader& in);
  /// Reads all keys but the seed.
  static GraspDraw read_limits(ConfigReader& in);
};

/// Draws a grasp. A contact point p is drawn on the surface by area; the other, q, is the last point of the object on
/// the line from p against the outward normal there. The grasp is kept if
/// - both normals are within atan(friction) of the line pq (antipodal: forces along it lie in both friction cones),
/// - |pq| is within the limits of the hand,
/// - the surface is at most `depth_m` behind p (and q) on the whole rim of the patch around it, and
/// - no other part of the object protrudes more than `depth_m` in front of p (and q) over the area of the gel's front,
///   whose middle faces the point. A domed front counts as flat. Other parts of the hand have no shape.
/// The result depends on the arguments alone.
/// \pre the object is closed and its normals point outwards
/// \throw DataError if no grasp was kept; the message says how many points each condition ruled out
GraspPose draw_grasp(const TriangleMesh& object, const Vector3& center_of_mass_m, const GelShape& front,
                     double friction, const GraspDraw& draw);

}  // namespace tacipc
