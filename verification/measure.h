// Numbers of one frame of a press, by name.
#pragma once

#include <string>
#include <vector>

#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "stages/gel/press/drive/simulate.h"
#include "verification/case_spec.h"

namespace tacipc::verify {

/// Names that `quantity` of a case may take, with unit and meaning.
struct Quantity {
  std::string name;
  std::string unit;
  std::string meaning;
};
const std::vector<Quantity>& quantities();

/// Results of a press, with what measuring them needs.
struct Outcome {
  const CaseSpec& spec;
  const TetMesh& gel;
  const TriangleMesh& object;
  const Simulation& simulation;
};

/// Depth of the object's lowest point below z = 0 in a frame, m.
double depth_m(const Outcome& outcome, int frame);
/// How far the object's frame has moved sideways, and turned about z, since the press ended, m and rad.
double sideways_m(const Outcome& outcome, int frame);
double turned_rad(const Outcome& outcome, int frame);

/// Distance that the barrier keeps between object and gel, the mean over the touching front vertices weighted by their
/// normal force, m. The gel meets the object as if it were that much larger and so much deeper. \throw UsageError for
/// objects other than sphere, punch, plate and block
double standoff_m(const Outcome& outcome, int frame);

/// The value of a quantity in a frame. \throw UsageError for a name that quantities() has not
double measure(const Outcome& outcome, const std::string& quantity, int frame);

/// Index of the frame that is meant. \throw DataError if the motion has none such
int find_frame(const Outcome& outcome, const FrameChoice& choice);

}  // namespace tacipc::verify
