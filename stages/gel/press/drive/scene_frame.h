// Frames of a scene.
#pragma once

#include <vector>

#include "stages/gel/press/measure/conservation.h"
#include "stages/gel/press/world/frame.h"

namespace tacipc {

/// One instant of a scene, in the world.
struct SceneFrame {
  double time_s = 0.0;
  int phase_index = -1;                       // index into the motion; −1 for frame 0
  std::vector<Matrix4> world_from_body = {};  // mounts of gels; initial poses of soft bodies
  std::vector<Vector3> velocity_m_s = {},
                       spin_rad_s = {};  // rigid bodies: velocity of the centre of mass, angular velocity
  std::vector<double> strain = {};       // rigid bodies: max |AᵀA − I|
  std::vector<Positions> soft_m = {};    // vertices of soft bodies
  /// Contact wrench on body a by body b about the world's origin, at a × number of bodies + b.
  std::vector<Wrench> between = {};
  std::optional<double> min_gap_m = {};  // between two bodies; absent beyond Scales::gap_horizon_m
  int intersections = 0;                 // intersecting pairs of triangles, by an exact test
  WholeAccount whole = {};  // all bodies that are neither fixed nor held; residuals are those of the frame's time steps
  StepReport solver = {};
};

/// A finished scene.
struct Scene {
  std::vector<Simulation> gels;  // each gel as a press run of its own, in its own frame S
  std::vector<SceneFrame> frames;
  std::vector<double> mass_kg;      // masses of the rigid bodies
  std::vector<ContactLaw> contact;  // laws of the pairs that the scene file names
  double slip_speed_m_s = 0.0;      // ε_v: slower contacts stick
  SolverTimes times;
};

}  // namespace tacipc
