// Relates the size of an object to a sensor's field of view, and suggests the unit of its file.
#pragma once

#include <string>

#include "common/mesh/triangle_mesh.h"
#include "stages/object/decimate/side_survey.h"

namespace tacipc {

/// Factor by which a side of this mesh fills nine tenths of the field of view; without `wanted` the side of most
/// relief.
double scale_to_window(const TriangleMesh& mesh, const SensorWindow& window, const std::string& wanted);

/// Hint such as " (in cm it is 20 mm wide)" for units with which the object is a third to three times `wanted_m`;
/// otherwise empty.
/// \param extent_m largest extent of the object
/// \param unit assumed unit of its numbers
std::string units_that_fit(double extent_m, const std::string& unit, double wanted_m);

}  // namespace tacipc
