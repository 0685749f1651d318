// Writes per-frame arrays of the contact and stress of a gel.
#pragma once

#include "common/mesh/tet_mesh.h"
#include "common/sample/array_folder.h"
#include "common/sensor/sensor.h"
#include "stages/gel/press/world/frame.h"

namespace tacipc {

/// Writes vertices of the front, their forces, states and first slip, and traction over the field of view.
void write_contact(const ArrayWriter& writer, const Sensor& sensor, const Simulation& simulation);

/// Writes stress in the gel, pressure and shear on its front, if the configuration asks for them. \pre there is a frame
void write_stress(const ArrayWriter& writer, const TetMesh& gel, const Simulation& simulation);

}  // namespace tacipc
