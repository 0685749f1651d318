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

/// Numbers that follow from the configuration and the gel.
struct Scales {
  double diagonal_m = 0.0;         // of the undeformed gel's bounding box
  double front_edge_m = 0.0;       // median edge of the front
  double d_hat_m = 0.0;            // d̂
  double gap_horizon_m = 0.0;      // gaps are measured up to this
  double start_gap_m = 0.0;        // between the object's lowest point and z = 0 in frame 0
  double barrier_stiffness = 0.0;  // κ, kg m⁻²
};
Scales scales_of(const PressConfig& config, const Sensor& sensor, const TetMesh& gel);

/// The element that the configuration asks for, "auto" decided by Poisson's ratio: "linear" or "averaged_volume".
std::string element_of(const PressConfig& config, const Material& material);

/// A deformable body: a gel, or a soft object.
struct DeformableBody {
  const Material& material;
  std::string element;  // element_of
  const TetMesh& mesh;  // where it is at rest
};
/// One body, or several of different materials, laws and elements that share no vertex, as the solver sees them: their
/// vertices and tetrahedra follow one another as in joined(). The glued vertices are those of all; a body without any
/// has no mount. \throw DataError naming the first tetrahedron of a body that is not positively oriented
GelModel make_gel_model(const std::vector<DeformableBody>& bodies);

/// The stress in a body's tetrahedra by the same law and element. \throw the same
TetStress tet_stress_of(const DeformableBody& body);

/// Settings with one law for all pairs of bodies.
StepSettings step_settings(const PressConfig& config, const Scales& scales);
/// How friction is solved.
FrictionSettings friction_settings(const FrictionConfig& friction, const Scales& scales);

/// Whether the object's surface is closed. \throw DataError if it is not, or looks inwards, but `pairs: once` counts on
/// it: which pieces of surface are near a vertex is told by what their edges and corners have in common
bool check_object(const TriangleMesh& object, const PressConfig& config);

/// \throw UsageError if the sensor's mount gives way: several gels and bodies are held by rigid ones
void require_rigid_mount(const Sensor& sensor);

/// \throw DataError or UsageError if the gel or the configuration does not allow the motion.
void check_motion(const SampleSpec& sample, const Sensor& sensor, const PressConfig& config);

}  // namespace tacipc
