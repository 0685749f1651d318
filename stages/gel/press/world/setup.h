// Quantities derived from configuration, sensor and gel before the first step.
#pragma once

#include <string>
#include <vector>

#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/sample_spec.h"
#include "common/sensor/sensor.h"
#include "stages/gel/press/energy/tet_energy.h"
#include "stages/gel/press/energy/tet_stress.h"
#include "stages/gel/press/solve/time_step.h"
#include "stages/gel/press/world/press_config.h"

namespace tacipc {

/// Lengths and stiffness that follow from the configuration and the gel.
struct Scales {
  double diagonal_m = 0.0;         // diagonal of the undeformed gel's bounding box
  double front_edge_m = 0.0;       // median edge length of the front
  double d_hat_m = 0.0;            // d̂: range of the barrier
  double gap_horizon_m = 0.0;      // larger gaps are not measured
  double start_gap_m = 0.0;        // gap in frame 0 between the object's lowest point and z = 0
  double barrier_stiffness = 0.0;  // κ, kg m⁻²
};
/// Computes these numbers.
Scales scales_of(const PressConfig& config, const Sensor& sensor, const TetMesh& gel);

/// Element that the configuration asks for, with "auto" decided by Poisson's ratio: "linear" or "averaged_volume".
std::string element_of(const PressConfig& config, const Material& material);

/// A deformable body: a gel or a soft object.
struct DeformableBody {
  const Material& material;
  std::string element;  // result of element_of()
  const TetMesh& mesh;  // mesh at rest
};
/// Model of one body, or of several with different materials, laws and elements that share no vertex: their vertices
/// and tetrahedra follow one another as in joined(). Glued vertices are those of all bodies; a body without any has no
/// mount.
/// \throw DataError that names the first tetrahedron of a body that is not positively oriented
GelModel make_gel_model(const std::vector<DeformableBody>& bodies);

/// Stress in a body's tetrahedra by the same law and element. \throw DataError as make_gel_model()
TetStress tet_stress_of(const DeformableBody& body);

/// Settings with one law for all pairs of bodies.
StepSettings step_settings(const PressConfig& config, const Scales& scales);
/// Settings of friction in metres and seconds.
FrictionSettings friction_settings(const FrictionConfig& friction, const Scales& scales);

/// Whether the object's surface is closed.
/// \throw DataError if it is open or faces inwards although `pairs: once` requires a closed one: the common edges and
/// corners of triangles determine which pieces of surface are near a vertex
bool check_object(const TriangleMesh& object, const PressConfig& config);

/// Checks the sensor for several gels and bodies.
/// \throw UsageError if its mount is compliant, which they do not support
void require_rigid_mount(const Sensor& sensor);

/// Checks the motion of a sample. \throw DataError or UsageError if the gel or the configuration does not allow it
void check_motion(const SampleSpec& sample, const Sensor& sensor, const PressConfig& config);

}  // namespace tacipc
