// Light from all sides, hidden where the membrane itself stands in its way.
#pragma once

#include <vector>

#include "common/base/types.h"

namespace tacipc {

struct MembraneView;

/// Bins of direction. Over azimuth they are hats: the radiance between two neighbouring centres is their linear
/// mixture. Over elevation it is constant between the given edges and, in the last band, up to the zenith.
struct DomeBins {
  int azimuths = 0;                        // centres, the first along x, from x towards y; 0: no dome
  std::vector<double> elevation_tan = {};  // lower edges of the bands, ascending, the first ≥ 0

  int bands() const { return static_cast<int>(elevation_tan.size()); }
  int size() const { return azimuths * bands(); }
};

/// Tangent of the elevation above which nothing of the membrane hides a direction of this azimuth (from x towards y)
/// from a pixel; negative where the membrane falls away. A march over the seen points, one pixel a step near the pixel
/// and growing with the distance by 1/16 of it, so that the horizon's place is known to that part.
double horizon_tangent(const MembraneView& view, int x, int y, double azimuth_rad);

/// Irradiance of a pixel, whose membrane has this normal, by each bin of unit radiance less that of the flat front:
///   ∫∫ h_k(α) max(−n · w, 0) cos ε dε dα,  w = (cos ε cos α, cos ε sin α, −sin ε),
/// over elevations ε of the band above the horizon, in closed form; over α by two directions a bin. Bins by azimuth,
/// then band. \pre out has bins.size() entries
void dome_irradiance(const DomeBins& bins, const MembraneView& view, int x, int y, const Vector3& normal, double* out);

}  // namespace tacipc
