// Membrane under a ball at any depth, interpolated from one simulated press run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// Frames of a ball pressed straight down over the origin of S.
struct BallPress {
  double radius_m = 0.0;          // radius of the ball
  Triangles front;                // triangles over the rows of every frame
  std::vector<double> depth_m;    // depth of the ball's lowest point below the undeformed front, ascending from frame 0
  std::vector<Positions> frames;  // front vertices, m
  std::vector<double> contact_m;  // radius of the contact rim, ascending

  /// Returns the front at a depth between the first and the last, by linear interpolation between frames.
  /// \throw DataError beyond the last frame
  Positions at_depth(double depth) const;
  /// Returns the depth at which the rim has this radius.
  /// \throw DataError, naming `what`, beyond the deepest frame
  double depth_of_contact(double rim_m, const std::string& what) const;
  /// Sets contact_m, taking for the rim the radius at which the gap has this width.
  void set_rim(double gap_m);
};

/// Returns the radius at which the gap between ball and membrane first exceeds `gap_m`, by interpolation of mean gaps
/// over rings of front vertices, 0.1 mm wide. 0 without contact.
double contact_radius(const Positions& front, double depth_m, double ball_radius_m, double gap_m);
/// Returns the gap at a distance from the ball's axis, over the same rings.
/// \pre radius_m < 0.95 ball_radius_m
double gap_at_radius(const Positions& front, double depth_m, double ball_radius_m, double radius_m);

/// Returns the pose that `press` gives to a ball over (x, y) at a depth; the ball's frame has its origin in the centre.
/// It is rotated by 180° about x, so that its +z side faces the gel.
Matrix4 ball_pose(double x_m, double y_m, double depth_m, double ball_radius_m);

/// Reads positions.npy and object_pose.npy of a press folder. The object's frame has its origin in the ball's centre.
/// \throw DataError if the files do not fit the gel, or the ball does not move straight down over the origin
BallPress read_ball_press(const std::filesystem::path& press, const std::filesystem::path& gel, double ball_radius_m,
                          double gap_m);

}  // namespace tacipc
