// Contact forces as force per area on a regular grid over the part of the front that the camera sees.
#pragma once

#include <cstddef>
#include <vector>

#include "common/sample/press_folder.h"
#include "common/sensor/sensor.h"
#include "stages/gel/press/measure/front_surface.h"

namespace tacipc {

/// Cells over a rectangle of the plane z = 0 of S; row 0 at the smallest y (top), column 0 at the smallest x (left).
struct TractionGrid {
  int rows = kTractionRows;
  int columns = kTractionColumns;
  double center_x_m = 0.0;
  double center_y_m = 0.0;
  double width_m = 0.0;   // extent along x
  double height_m = 0.0;  // extent along y

  /// Grid over the rectangle of the undeformed front that the camera sees.
  static TractionGrid over_window(const Camera& camera);
  double cell_area_m2() const { return width_m / columns * (height_m / rows); }
};

/// Distributes the forces on the front vertices (N, #V_front × 3) over the cells. The force on a vertex acts on the
/// deformed triangles around it, with a density that falls linearly to zero at their other corners. Each triangle is
/// cut into n² equal ones with edges of at most a quarter of a cell in x and y. The force on each small triangle goes
/// from its centre to the four nearest cells with bilinear weights. Force beyond the border stays in the cells along
/// it.
///
/// The cells' traction times their area sums to the forces on the vertices whose deformed positions lie inside the
/// rectangle, to rounding. A uniform pressure on a flat front is reproduced in each cell to within 1 %. In cells along
/// the border, where whole vertices are in or out, the error is up to (triangle edge) / (cell edge). Areas are those of
/// the plane z = 0: on a slope the traction is per projected area.
/// \return (rows, columns, 2, 3) in Pa: normal [0] and friction [1], on the gel, frame S
std::vector<double> spread_traction(const TractionGrid& grid, const FrontSurface& front,
                                    const Positions& front_positions, const Positions& normal_n,
                                    const Positions& friction_n);

}  // namespace tacipc
