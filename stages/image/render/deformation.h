// A gel's front face, frame by frame, as input of render: from a press, or from height maps.
#pragma once

#include <vector>

#include "common/optics/membrane.h"
#include "common/optics/trace.h"

namespace tacipc {

/// Interface to the frames; frame 0 is the gel at rest.
class Deformation {
 public:
  virtual ~Deformation() = default;
  virtual std::size_t num_frames() const = 0;
  /// Last frame of each phase of the motion, ascending; empty if phases are unknown. Neighbouring phases of one kind
  /// count as one.
  virtual std::vector<std::size_t> phase_ends() const { return {}; }
  virtual Membrane at_rest() const = 0;
  /// Moves the membrane from `at_rest` to a frame.
  virtual void move(Membrane& membrane, std::size_t frame) const = 0;
  /// Contact state and traction on the membrane's vertices in a frame, if they are known.
  virtual SurfaceFields fields(std::size_t, const Membrane&) const { return {}; }
  /// Markers in a frame, #M × 3, m; no rows if there are none.
  virtual Positions markers(std::size_t) const { return Positions(0, 3); }
};

}  // namespace tacipc
