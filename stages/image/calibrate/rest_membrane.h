// Front of a gel at rest, from its shape alone.
#pragma once

#include "common/optics/membrane.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// The undeformed front face: a disc of rings, or a grid, with edges of at most 0.5 mm along radius or axes; every
/// vertex lies on the front.
Membrane rest_membrane(const GelShape& shape);

}  // namespace tacipc
