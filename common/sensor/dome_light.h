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

/// What the bins of a dome give to the pixels of one view.
class DomeIrradiance {
 public:
  /// \pre the view stays as it is, but for its normals
  DomeIrradiance(const DomeBins& bins, const MembraneView& view);

  /// Irradiance of a pixel, whose membrane has this normal, by each bin of unit radiance less that of the flat front:
  ///   ∫∫ h_k(α) max(−n · w, 0) cos ε dε dα,  w = (cos ε cos α, cos ε sin α, −sin ε),
  /// over elevations ε of the band above the horizon, in closed form; over α by two directions a bin. Bins by azimuth,
  /// then band. A horizon whose tangent is below 0.005 is not looked for: it hides 3e-5 of the light of a flat pixel,
  /// and of one that faces it at most 1 % of what comes from that direction. \pre out has bins.size() entries
  void at(int x, int y, const Vector3& normal, double* out) const;

  /// The horizons of a row of pixels, by direction, then pixel: for whole images, where marches side by side read the
  /// same lines of points. Those below 0.005 are −∞.
  std::vector<double> row_horizons(int y) const;
  /// As above, with the horizons that this row has.
  void at(int x, const std::vector<double>& row_horizons, const Vector3& normal, double* out) const;

 private:
  /// From the plane up to elevation ε of a tangent: ∫ cos² ε and ∫ sin ε cos ε, of which the irradiance per azimuth is
  /// n_z · across − A · along, A = n_x cos α + n_y sin α.
  struct Elevation {
    double along = 0.0, across = 0.0;

    static Elevation of(double tangent);
    double integral(double a, double nz) const { return nz * across - a * along; }
  };
  struct Direction {
    double cosine = 0.0, sine = 0.0;
    double dx = 0.0, dy = 0.0;          // a step of one pixel's width, in pixels
    std::vector<double> lowest;         // by block of pixels: z of the deepest point on the way from any of them
    std::vector<double> lowest_of_row;  // of a row of blocks
  };
  template <typename Horizon>
  void integrate(const Vector3& normal, const Horizon& horizon, double* out) const;

  DomeBins bins_;
  const MembraneView* view_;
  std::vector<double> z_;  // of its points
  int blocks_wide_ = 0;
  double pixel_m_ = 0.0;
  std::vector<Elevation> edges_;  // of the bands, and the zenith
  std::vector<Elevation> bands_;  // from edge to edge
  std::vector<Direction> directions_;
};

}  // namespace tacipc
