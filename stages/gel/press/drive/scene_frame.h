// Frames of a scene.
#pragma once

#include <vector>

#include "stages/gel/press/measure/conservation.h"
#include "stages/gel/press/world/frame.h"

namespace tacipc {

/// One instant of a scene, in the world.
struct SceneFrame {
  double time_s = 0.0;
  int phase_index = -1;                                     // into the motion; −1 for frame 0
  std::vector<Matrix4> world_from_body = {};                // of gels their mounts, of soft bodies where they began
  std::vector<Vector3> velocity_m_s = {}, spin_rad_s = {};  // of rigid bodies: of their centres of mass, and about them
  std::vector<double> strain = {};                          // of rigid bodies: max |AᵀA − I|
  std::vector<Positions> soft_m = {};                       // of soft bodies
  std::vector<Wrench> between = {};      // on body a by body b, about the world's origin, at a × number of bodies + b
  std::optional<double> min_gap_m = {};  // between two bodies; nothing beyond Scales::gap_horizon_m
  int intersections = 0;                 // pairs of triangles, by an exact test
  WholeAccount whole = {};  // of all but what is fixed or held; the residuals are those of the frame's time steps
  StepReport solver = {};
};

struct Scene {
  std::vector<Simulation> gels;  // each as a press of its own, in its own frame S
  std::vector<SceneFrame> frames;
  std::vector<double> mass_kg;      // of rigid bodies
  std::vector<ContactLaw> contact;  // of the pairs that the scene's file names
  double slip_speed_m_s = 0.0;      // ε_v: slower contacts stick
  SolverTimes times;
};

}  // namespace tacipc
