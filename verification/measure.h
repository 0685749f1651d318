// Quantities of one frame of a press, by name.
#pragma once

#include <string>
#include <vector>

#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "stages/gel/press/drive/simulate.h"
#include "verification/case_spec.h"

namespace tacipc::verify {

/// Name that `quantity` of a case may take, with its unit and meaning.
struct Quantity {
  std::string name;
  std::string unit;
  std::string meaning;
};
const std::vector<Quantity>& quantities();

/// Results of a press, and the inputs needed to measure them.
struct Outcome {
  const CaseSpec& spec;
  const TetMesh& gel;
  const TriangleMesh& object;
  const Simulation& simulation;
};

/// Depth of the object's lowest point below z = 0 in a frame, m.
double depth_m(const Outcome& outcome, int frame);
/// Sideways displacement (m) and rotation about z (rad) of the object's frame since the end of the press.
double sideways_m(const Outcome& outcome, int frame);
double turned_rad(const Outcome& outcome, int frame);

/// Stand-off: gap that the barrier keeps between object and gel, as the mean over the touching front vertices weighted
/// by their normal force, m. The gel sees an object that is enlarged and deeper by this gap.
/// \throw UsageError for objects other than sphere, punch, plate and block
double standoff_m(const Outcome& outcome, int frame);

/// Value of a quantity in a frame.
/// \throw UsageError for a name that is not in quantities()
double measure(const Outcome& outcome, const std::string& quantity, int frame);

/// Index of the selected frame.
/// \throw DataError if the motion has no such frame
int find_frame(const Outcome& outcome, const FrameChoice& choice);

}  // namespace tacipc::verify
