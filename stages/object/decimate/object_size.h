// How large an object is wanted, and which unit would make it so.
#pragma once

#include <string>

#include "common/mesh/triangle_mesh.h"
#include "stages/object/decimate/side_survey.h"

namespace tacipc {

/// The factor that makes a side of this mesh (that of most relief without `wanted`) fill nine tenths of the window.
double scale_to_window(const TriangleMesh& mesh, const SensorWindow& window, const std::string& wanted);

/// " (in cm it is 20 mm wide)", if these units would make it about as large as `wanted_m`, a third to three times; else
/// nothing. `extent_m` is its largest extent, `unit` what its numbers were taken for.
std::string units_that_fit(double extent_m, const std::string& unit, double wanted_m);

}  // namespace tacipc
