// Runs a whole motion of one object through the gel's grid, frame by frame.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/mesh/triangle_mesh.h"
#include "common/sample/sample_spec.h"
#include "common/sensor/sensor.h"
#include "stages/rival/mpm/gel_lattice.h"
#include "stages/rival/mpm/material_points.h"

namespace tacipc {

/// One saved instant; frame 0 is the gel at rest.
struct MpmFrame {
  double time_s = 0.0;
  PhaseKind phase = PhaseKind::reference;
  int phase_index = -1;  // index into the sample's motion; −1 for frame 0
  Matrix4 gel_from_object = Matrix4::Identity();
  Positions front_m;            // front: the top layer's columns, at z = 0 at rest
  double gel_depth_m = 0.0;     // depth of the front's deepest point below z = 0
  double object_depth_m = 0.0;  // depth of the object's lowest point, < 0 above z = 0
  Vector3 momentum_kg_m_s = Vector3::Zero();
  double kinetic_energy_j = 0.0;
  int steps = 0;  // steps since frame 0
};

/// All inputs of a run; none changes while the object moves.
struct MpmScene {
  MpmConfig config;
  SampleSpec sample;
  std::string face;  // face of the object that presses
  GelLattice lattice;
  MpmSetup setup;
  TriangleMesh object;
  Positions object_points_m;

  double points_per_m2() const;  // per area of the object's whole surface
};

/// Fills the gel with particles and the object's surface with points.
/// \throw UsageError if the sample asks for a load
/// \throw DataError as make_gel_lattice and sample_surface, and for presses deeper than the gel
MpmScene make_scene(const MpmConfig& config, const Sensor& sensor, const SampleSpec& sample, const TriangleMesh& object,
                    const std::string& default_face);

/// Frames of a run, and its statistics.
struct MpmRun {
  std::vector<MpmFrame> frames;
  int sorts = 0;
  std::size_t grid_nodes = 0;       // grid nodes at the end of the run
  double object_speed_m_s = 0.0;    // largest speed of any point of the object
  double particle_speed_m_s = 0.0;  // largest speed of any particle
};

using MpmObserver = std::function<void(int frame, int num_frames, int steps, double gel_depth_m)>;

/// Moves the object through its phases at `speed_factor` times the configured speed.
/// \throw SolverError if the step is too long or the object passes through the gel
MpmRun run_motion(const MpmScene& scene, double speed_factor, const MpmObserver& observe);

}  // namespace tacipc
