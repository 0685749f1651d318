// A gel's front face, frame by frame, as render takes it: from a press, or from height maps.
#pragma once

#include <vector>

#include "common/optics/membrane.h"
#include "common/optics/trace.h"

namespace tacipc {

/// Frame 0 is the gel at rest.
class Deformation {
 public:
  virtual ~Deformation() = default;
  virtual std::size_t num_frames() const = 0;
  /// The last frame of each phase of the motion, ascending; none where nothing is known of phases. Neighbouring phases
  /// of one kind count as one.
  virtual std::vector<std::size_t> phase_ends() const { return {}; }
  virtual Membrane at_rest() const = 0;
  /// Takes the membrane of `at_rest` to a frame.
  virtual void move(Membrane& membrane, std::size_t frame) const = 0;
  /// Contact state and traction on the membrane's vertices in a frame, where they are known.
  virtual SurfaceFields fields(std::size_t, const Membrane&) const { return {}; }
  /// Markers in a frame, #M × 3, m; no rows where there are none.
  virtual Positions markers(std::size_t) const { return Positions(0, 3); }
};

}  // namespace tacipc
