// Light from all directions (a dome), with shadows of the membrane on itself.
#pragma once

#include <vector>

#include "common/base/types.h"

namespace tacipc {

struct MembraneView;

/// Bins of direction. In azimuth, bins are hat functions: the radiance between two neighbouring centres is interpolated
/// linearly. In elevation, it is constant between the given edges and, in the last band, up to the zenith.
struct DomeBins {
  int azimuths = 0;                        // number of centres, from x towards y, the first along x; 0: no dome
  std::vector<double> elevation_tan = {};  // lower edges of the bands, ascending, the first ≥ 0

  int bands() const { return static_cast<int>(elevation_tan.size()); }
  int size() const { return azimuths * bands(); }
};

/// Returns the tangent of the horizon's elevation in one azimuth (from x towards y): above it, the membrane hides no
/// direction from the pixel. Negative if the membrane falls away. Marches over the visible points; steps are one pixel
/// near the pixel and grow with 1/16 of the distance, which bounds the relative error of the horizon's distance.
double horizon_tangent(const MembraneView& view, int x, int y, double azimuth_rad);

/// Irradiance that each bin of a dome gives to the pixels of one view.
class DomeIrradiance {
 public:
  /// \pre the view does not change, except for its normals
  DomeIrradiance(const DomeBins& bins, const MembraneView& view);

  /// Computes the irradiance of a pixel with this membrane normal, for unit radiance of each bin, minus that of the
  /// flat front:
  ///   ∫∫ h_k(α) max(−n · w, 0) cos ε dε dα,  w = (cos ε cos α, cos ε sin α, −sin ε),
  /// over elevations ε of the band above the horizon, in closed form, and over α by two directions per bin. Bins are
  /// ordered by azimuth, then band. Horizons with a tangent below 0.005 are ignored: they hide 3e-5 of the light of a
  /// flat pixel, and at most 1 % of the light from their direction on a pixel that faces it.
  /// \pre out has bins.size() entries
  void at(int x, int y, const Vector3& normal, double* out) const;

  /// Computes the horizons of a row of pixels, ordered by direction, then pixel. Faster for whole images, because
  /// neighbouring marches read the same rows of points. Horizons below 0.005 are −∞.
  std::vector<double> row_horizons(int y) const;
  /// Computes the irradiance of a pixel from the horizons of its row.
  void at(int x, const std::vector<double>& row_horizons, const Vector3& normal, double* out) const;

 private:
  /// Integrals from the plane up to elevation ε, given by its tangent: ∫ cos² ε and ∫ sin ε cos ε. The irradiance per
  /// azimuth is n_z · across − A · along, with A = n_x cos α + n_y sin α.
  struct Elevation {
    double along = 0.0, across = 0.0;

    static Elevation of(double tangent);
    double integral(double a, double nz) const { return nz * across - a * along; }
  };
  struct Direction {
    double cosine = 0.0, sine = 0.0;
    double dx = 0.0, dy = 0.0;          // step of one pixel's width, in pixels
    std::vector<double> lowest;         // per block of pixels: z of the deepest point ahead of any of them
    std::vector<double> lowest_of_row;  // per row of blocks
  };
  template <typename Horizon>
  void integrate(const Vector3& normal, const Horizon& horizon, double* out) const;

  DomeBins bins_;
  const MembraneView* view_;
  std::vector<double> z_;  // z of the view's points
  int blocks_wide_ = 0;
  double pixel_m_ = 0.0;
  std::vector<Elevation> edges_;  // edges of the bands, and the zenith
  std::vector<Elevation> bands_;  // bands from edge to edge
  std::vector<Direction> directions_;
};

}  // namespace tacipc
