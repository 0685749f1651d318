// Rim of a gel seen from above, as panels between its corners.
#pragma once

#include <functional>
#include <vector>

#include "common/sensor/sensor.h"
#include "stages/gel/tetmesh/delaunay.h"

namespace tacipc {

/// One smooth piece of the rim, traversed counter-clockwise. A disc is one closed panel, a rectangle has four sides.
struct Panel {
  std::function<Vector2(double)> at;  // t in [0, 1] → point, at constant speed
  double length_m = 0.0;
  int min_edges = 1;
};
/// Panels of the rim of a gel, in order.
std::vector<Panel> panels(const GelShape& gel);

/// Distance of a point from the rim, positive inside.
double distance_inside(const GelShape& gel, const Vector2& point);
/// The point itself, or the nearest one at least `margin_m` inside the rim.
Vector2 pulled_inside(const GelShape& gel, const Vector2& point, double margin_m);

/// Parameters 0 = t₀ < … < t_n = 1 whose steps have equal shares of ∫ ds / h, with n the nearest number of edges to it.
/// \param edge_length h at a parameter
std::vector<double> graded_parameters(double length_m, int min_edges, const std::function<double(double)>& edge_length);

}  // namespace tacipc
