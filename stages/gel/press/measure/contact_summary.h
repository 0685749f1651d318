// A contact in numbers: its area, its pressure, how much of it sticks.
#pragma once

#include <vector>

#include "common/sample/contact_state.h"
#include "stages/gel/press/measure/front_surface.h"

namespace tacipc {

struct ContactSummary {
  double area_m2 = 0.0;           // Σ lumped deformed areas of the front vertices with a normal force
  double mean_pressure_pa = 0.0;  // Σ |normal force| / area; 0 without contact
  double peak_pressure_pa = 0.0;  // largest |normal force| / lumped area of a vertex
  int sticking = 0;               // vertices of each state
  int slipping = 0;
};

/// Measures the contact of one frame. `normal_n` is the normal force on each front vertex, N; areas are of the deformed
/// front, so a vertex at the rim of the contact counts with its whole share: the area is exact to half a row of
/// triangles around the rim. \throw SolverError if a vertex with a force has no area (its triangles have collapsed).
ContactSummary measure_contact(const FrontSurface& front, const Positions& front_positions, const Positions& normal_n,
                               const std::vector<ContactState>& states);

}  // namespace tacipc
