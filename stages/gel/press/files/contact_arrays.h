// Arrays of what acts on a gel's front, frame by frame.
#pragma once

#include "common/mesh/tet_mesh.h"
#include "common/sample/array_folder.h"
#include "common/sensor/sensor.h"
#include "stages/gel/press/world/frame.h"

namespace tacipc {

/// Vertices of the front, their forces, states and first slip, traction over the camera's window.
void write_contact(const ArrayWriter& writer, const Sensor& sensor, const Simulation& simulation);

/// Stress in the gel, pressure and shear on its front, if the configuration asks for them. \pre there is a frame
void write_stress(const ArrayWriter& writer, const TetMesh& gel, const Simulation& simulation);

}  // namespace tacipc
