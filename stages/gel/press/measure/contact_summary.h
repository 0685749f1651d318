// Contact area, pressure, and number of sticking and slipping vertices of a frame.
#pragma once

#include <vector>

#include "common/sample/contact_state.h"
#include "stages/gel/press/measure/front_surface.h"

namespace tacipc {

/// Summary of the contact of one frame.
struct ContactSummary {
  double area_m2 = 0.0;           // Σ lumped deformed areas of the front vertices with a normal force
  double mean_pressure_pa = 0.0;  // Σ |normal force| / area; 0 without contact
  double peak_pressure_pa = 0.0;  // largest |normal force| / lumped area of a vertex
  int sticking = 0;               // number of sticking vertices
  int slipping = 0;               // number of slipping vertices
};

/// Measures the contact of one frame. Areas are those of the deformed front. A vertex at the rim of the contact counts
/// with its whole lumped area, so the area is uncertain by half a row of triangles around the rim.
/// \param normal_n normal force on each front vertex, N
/// \throw SolverError if a vertex with a force has no area (its triangles have collapsed)
ContactSummary measure_contact(const FrontSurface& front, const Positions& front_positions, const Positions& normal_n,
                               const std::vector<ContactState>& states);

}  // namespace tacipc
