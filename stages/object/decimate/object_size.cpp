#include "stages/object/decimate/object_size.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "stages/object/decimate/surface_topology.h"

namespace tacipc {
namespace {

constexpr std::array kUnits{"um", "mm", "cm", "in", "m"};

}  // namespace

double scale_to_window(const TriangleMesh& mesh, const SensorWindow& window, const std::string& wanted) {
  constexpr double kFilled = 0.9;
  const double window_m = kFilled * std::min(window.size_m[0], window.size_m[1]);
  double scale = window_m / largest_extent(mesh);
  // The side of most relief depends on the size: first the whole object is scaled to fit, then this side.
  TriangleMesh scaled = mesh;
  scaled.positions *= scale;
  const SideView side = survey_sides(scaled, window, wanted).side();
  return scale * kFilled * std::min(window.size_m[0] / side.extent_m[0], window.size_m[1] / side.extent_m[1]);
}

std::string units_that_fit(double extent_m, const std::string& unit, double wanted_m) {
  constexpr double kAbout = 3.0;
  std::string fitting;
  for (const char* other : kUnits) {
    const double extent = extent_m * metres_per_unit(other) / metres_per_unit(unit);
    if (other == unit || extent * kAbout < wanted_m || extent > kAbout * wanted_m) continue;
    fitting += fmt::format("{}in {} it is {:.3g} mm wide", fitting.empty() ? "" : ", ", other, 1e3 * extent);
  }
  return fitting.empty() ? "" : " (" + fitting + ")";
}

}  // namespace tacipc
